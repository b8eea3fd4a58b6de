"""What the package lets geodisk_cpu bring, by a stand-in of it."""

import json
import os
import subprocess
import sys

import pytest

# Prints what a process has after its first look for devices.
ASK = """
import json, os
from geodisk import _cpu
names = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES", "VK_ADD_DRIVER_FILES"]
before = {name: os.environ.get(name) for name in names}
_cpu.provide()
print(json.dumps([before, {name: _cpu.environment().get(name) for name in names}]))
"""


def ask(folder, before="", **variables):
    environment = {k: v for k, v in os.environ.items() if not k.startswith("VK_")}
    environment["PYTHONPATH"] = os.pathsep.join([str(folder), os.environ["PYTHONPATH"]])
    told = subprocess.run(
        [sys.executable, "-c", ASK.replace("_cpu.provide()", before + "_cpu.provide()")],
        env={**environment, **variables},
        check=True,
        capture_output=True,
    )
    return json.loads(told.stdout)


@pytest.fixture
def stand_in(tmp_path):
    package = tmp_path / "geodisk_cpu"
    package.mkdir()
    (package / "__init__.py").write_text("LOADER, DRIVER = '/no/loader.so', '/no/driver.json'\n")
    return tmp_path


def test_the_system_has_a_driver(stand_in):
    before, after = ask(stand_in)
    assert before == after


def test_no_package(tmp_path):
    before, after = ask(tmp_path, VK_ADD_DRIVER_FILES="")
    assert before == after


@pytest.mark.parametrize("name", ["VK_DRIVER_FILES", "VK_ICD_FILENAMES", "VK_ADD_DRIVER_FILES"])
def test_the_user_chose_a_driver(stand_in, name):
    before, after = ask(stand_in, **{name: "/mine.json"})
    assert before[name] == "/mine.json" and before == after


def test_no_other_driver(stand_in):
    # A library that lists none stands for a system without drivers.
    before, after = ask(stand_in, before="_cpu.c.list_devices = lambda: []; ")
    assert before == dict.fromkeys(before)
    assert after["VK_DRIVER_FILES"] == after["VK_ICD_FILENAMES"] == "/no/driver.json"


ASK_FOR_DEVICES = """
import geodisk
from geodisk import _library

def none():
    raise geodisk.NoDevice("no driver", "no_device")

_library.list_devices = none
try:
    geodisk.devices()
except geodisk.NoDevice as error:
    print(error, error.status)
"""


def told_without_devices(folder, **variables):
    environment = {k: v for k, v in os.environ.items() if not k.startswith("VK_")}
    environment["PYTHONPATH"] = os.pathsep.join([str(folder), os.environ["PYTHONPATH"]])
    return subprocess.run(
        [sys.executable, "-c", ASK_FOR_DEVICES],
        env={**environment, **variables},
        check=True,
        capture_output=True,
        text=True,
    ).stdout.strip()


@pytest.mark.skipif(sys.platform != "linux", reason="the package is for Linux")
def test_the_package_is_named_where_it_would_help(tmp_path):
    expected = "no driver; pip install 'geodisk[cpu]' brings a driver for the CPU no_device"
    assert told_without_devices(tmp_path) == expected
    assert told_without_devices(tmp_path, VK_DRIVER_FILES="/mine.json") == "no driver no_device"


def test_the_package_is_not_named_where_it_is(stand_in):
    assert told_without_devices(stand_in) == "no driver no_device"
