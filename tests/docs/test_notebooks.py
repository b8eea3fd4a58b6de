"""The notebooks of tools/examples/notebooks, run from top to bottom, each in a folder of its own.

With --basetemp=FOLDER the pictures stay there, to be looked at.
"""

import base64
import importlib.util
import pathlib
import re
import sys

import nbclient
import nbformat
import pytest

NOTEBOOKS = pathlib.Path(__file__).parents[2] / "tools/examples/notebooks"


def code_of(book):
    return [cell for cell in book.cells if cell.cell_type == "code"]


def needs_of(book):
    """Packages that the first cell says the notebook needs."""
    return re.findall(r"`(\w+)`", book.cells[0].source.rpartition("Needs ")[2])


@pytest.fixture(params=sorted(NOTEBOOKS.glob("*.ipynb")), ids=lambda path: path.stem)
def path(request):
    return request.param


@pytest.fixture
def book(path):
    return nbformat.read(path, 4)


def test_is_stored_without_outputs(book):
    nbformat.validate(book)
    assert 5 <= len(book.cells) <= 12
    assert all(cell.outputs == [] and cell.execution_count is None for cell in code_of(book))


def test_says_what_it_needs(book):
    imported = re.findall(r"^(?:import|from) (\w+)", "\n".join(cell.source for cell in code_of(book)), re.M)
    assert {*needs_of(book), "numpy"} == {*imported} - sys.stdlib_module_names


def test_runs_and_shows_one_picture(path, book, tmp_path_factory):
    missing = [name for name in needs_of(book) if not importlib.util.find_spec(name)]
    if missing:
        pytest.skip(f"not installed: {', '.join(missing)}")
    folder = tmp_path_factory.mktemp(path.stem, numbered=False)
    nbclient.NotebookClient(book, timeout=300, resources={"metadata": {"path": str(folder)}}).execute()
    outputs = [output for cell in code_of(book) for output in cell.outputs]
    (picture,) = (output.data["image/png"] for output in outputs if "image/png" in output.get("data", {}))
    (folder / "picture.png").write_bytes(base64.b64decode(picture))
    nbformat.write(book, folder / path.name)
