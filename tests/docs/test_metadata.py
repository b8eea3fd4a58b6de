"""Files that name the version and the address of the project: all name the same."""

import pathlib
import re

import pytest

SOURCE = pathlib.Path(__file__).parents[2]
VERSION = re.search(r"^ +VERSION (\d+\.\d+\.\d+)$", (SOURCE / "CMakeLists.txt").read_text(), re.M).group(1)
ADDRESS = "https://github.com/geodisk/geodisk"


@pytest.mark.parametrize(
    "file",
    [
        "CITATION.cff",
        "tools/packaging/conda/recipe.yaml",
        "tools/packaging/vcpkg/vcpkg.json",
        "tools/packaging/wheel/cpu/pyproject.toml",
        "tools/python/pyproject.toml",
    ],
)
def test_version(file):
    pattern = r'^ *"?version"? *[:=] *"?(\d[\d.]*)'
    assert re.findall(pattern, (SOURCE / file).read_text(), re.M) == [VERSION]


@pytest.mark.parametrize(
    "file",
    [
        ".github/ISSUE_TEMPLATE/config.yml",
        ".github/ISSUE_TEMPLATE/device.yml",
        "CITATION.cff",
        "tools/packaging/conan/conanfile.py",
        "tools/packaging/conda/recipe.yaml",
        "tools/packaging/site/mkdocs.yml",
        "tools/packaging/vcpkg/vcpkg.json",
        "tools/packaging/wheel/cpu/pyproject.toml",
        "tools/python/pyproject.toml",
    ],
)
def test_address(file):
    """Of all addresses at GitHub, that of the project, and those below it."""
    found = re.findall(r"https://github\.com/geodisk[^\s\")]*", (SOURCE / file).read_text())
    assert found and all(re.match(rf"{ADDRESS}($|/)", address) for address in found)
