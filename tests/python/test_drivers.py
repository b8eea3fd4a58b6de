"""Warnings of Vulkan drivers that the loader leaves out."""

import json
import os
import subprocess
import sys

import pytest

import geodisk

USE = """
import sys, warnings, geodisk
with warnings.catch_warnings(record=True) as found:
    warnings.simplefilter("always")
    for i in range(2):
        geodisk.sample("builtin:cube", min_distance=0.5, device=eval(sys.argv[1]))
for one in found:
    if getattr(one.message, "kind", "") == "left_out_driver":
        print(one.filename, one.message)
"""


@pytest.fixture(autouse=True, scope="module")
def only_a_cpu():
    if os.environ.get("VK_DRIVER_FILES") or os.environ.get("VK_ICD_FILENAMES"):
        pytest.skip("these variables replace the one that the tests set")
    if any(device.usable and device.type != "cpu" for device in geodisk.devices()):
        pytest.skip("a device that is no CPU is used")


def warnings_with(folder, library, device="None", **variables):
    """Returns what two runs in a process of their own warn of, with a driver of this library."""
    manifest = folder / "driver.json"
    driver = {"library_path": library, "api_version": "1.3.0"}
    manifest.write_text(json.dumps({"file_format_version": "1.0.0", "ICD": driver}))
    told = subprocess.run(
        [sys.executable, "-c", USE, device],
        env={**os.environ, "VK_ADD_DRIVER_FILES": str(manifest), **variables},
        check=True,
        capture_output=True,
        text=True,
    )
    return manifest, told.stdout.splitlines()


def test_a_driver_left_out_is_named_once(tmp_path):
    manifest, lines = warnings_with(tmp_path, "libnot_here.so.0")
    assert len(lines) == 1
    where = f"<string> the CPU is used, since a Vulkan driver is left out: {manifest}"
    assert lines[0].startswith(f"{where}, whose library libnot_here.so.0 does not load (")


def test_the_program_says_the_same(tmp_path):
    manifest, lines = warnings_with(tmp_path, "libnot_here.so.0")
    told = subprocess.run(
        [os.environ["GEODISK_COMMAND"], "sample", "builtin:cube", "-d", "0.5", "-o", "a.csv"],
        env={**os.environ, "VK_ADD_DRIVER_FILES": str(manifest)},
        check=True,
        capture_output=True,
        text=True,
        cwd=tmp_path,
    )
    assert lines[0].removeprefix("<string> ") in told.stderr


def test_a_library_that_is_no_driver(tmp_path):
    libc = next(line.split()[-1] for line in open("/proc/self/maps") if "/libc.so" in line)
    _, lines = warnings_with(tmp_path, libc)
    assert len(lines) == 1 and lines[0].endswith(f"whose library {libc} is no Vulkan driver")


@pytest.mark.parametrize("name", ["device", "variable"])
def test_a_chosen_device_needs_no_warning(tmp_path, name):
    index = next(device.index for device in geodisk.devices() if device.usable)
    if name == "device":
        _, lines = warnings_with(tmp_path, "libnot_here.so.0", str(index))
    else:
        _, lines = warnings_with(tmp_path, "libnot_here.so.0", GEODISK_DEVICE=str(index))
    assert lines == []


def test_the_driver_of_the_package_is_used_for_one_left_out(tmp_path):
    # A stand-in of geodisk_cpu with the system's driver, in a system that has none.
    told = subprocess.run(
        [sys.executable, "-c", STAND_IN],
        env={**os.environ, "PYTHONPATH": os.pathsep.join([str(tmp_path), os.environ["PYTHONPATH"]])},
        check=True,
        capture_output=True,
        text=True,
    )
    assert told.stdout.split() == ["before", "before"]


STAND_IN = """
import os, sys, types
from geodisk import _cpu
package = types.ModuleType("geodisk_cpu")
package.LOADER, package.DRIVER = "libvulkan.so.1", "/mine.json"
sys.modules["geodisk_cpu"] = package
_cpu._user_chose = _cpu._a_device_is_usable = lambda: False
_cpu.left_out_drivers = lambda: "after" if os.environ.get("VK_DRIVER_FILES") else "before"
print(_cpu.warnings_of_drivers())
_cpu.provide()
print(_cpu.warnings_of_drivers())
"""
