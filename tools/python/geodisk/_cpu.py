"""The loader and the driver of the package geodisk_cpu, for machines that lack one."""

from __future__ import annotations

import contextlib
import ctypes
import functools
import importlib
import os
import sys
from types import ModuleType
from typing import Iterator

from . import _library as c
from ._errors import GeodiskWarning, NoDevice
from ._oddities import left_out_drivers

# Each names drivers that the user chose.
_CHOICES = ("VK_DRIVER_FILES", "VK_ICD_FILENAMES", "VK_ADD_DRIVER_FILES")
_LOADER = "libvulkan.so.1"


def _package() -> ModuleType | None:
    try:
        return importlib.import_module("geodisk_cpu")
    except ModuleNotFoundError:
        return None


def _is_there(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def _user_chose() -> bool:
    return any(name in os.environ for name in _CHOICES)


def _a_device_is_usable() -> bool:
    try:
        return any(device.is_usable for device in c.list_devices())
    except NoDevice:
        return False


@functools.lru_cache(maxsize=None)
def _library_folder() -> str | None:
    """Folder of the package's loader, if the system has none. Loads it."""
    package = _package()
    if package is None or _is_there(_LOADER):
        return None
    # The C library opens the loader by its name, and gets the one that is loaded.
    return os.path.dirname(package.LOADER) if _is_there(package.LOADER) else None


#: Warnings of drivers left out, from before provide() has chosen the package's driver.
_left_out: tuple[GeodiskWarning, ...] | None = None


@functools.lru_cache(maxsize=None)
def provide() -> None:
    """Lets this process use the package's driver if no other device is usable.

    It sets VK_DRIVER_FILES and VK_ICD_FILENAMES, unless the user has chosen drivers.
    """
    global _left_out
    package = _package()
    if package is None:
        return
    _library_folder()
    if _user_chose() or _a_device_is_usable():
        return
    _left_out = left_out_drivers()
    for name in ("VK_DRIVER_FILES", "VK_ICD_FILENAMES"):  # Older loaders know the second alone.
        os.environ[name] = package.DRIVER


def warnings_of_drivers() -> tuple[GeodiskWarning, ...]:
    """Returns warnings of drivers that do not load, for a process that uses a CPU."""
    return left_out_drivers() if _left_out is None else _left_out


@contextlib.contextmanager
def advice() -> Iterator[None]:
    """Lets a NoDevice name the package, where that would bring a device."""
    try:
        yield
    except NoDevice as error:
        if sys.platform != "linux" or _package() is not None or _user_chose() or _a_device_is_usable():
            raise
        hint = "; pip install 'geodisk[cpu]' brings a driver for the CPU"
        raise NoDevice(f"{error}{hint}", error.status) from None


def environment() -> dict[str, str]:
    """Returns the environment in which programs find the same loader and driver."""
    variables = dict(os.environ)
    folder = _library_folder()
    if folder is not None:
        paths = [variables.get("LD_LIBRARY_PATH"), folder]
        variables["LD_LIBRARY_PATH"] = os.pathsep.join(filter(None, paths))
    return variables
