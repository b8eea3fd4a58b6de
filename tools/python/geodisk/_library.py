"""The library of the package, by ctypes: geodisk/geodisk.h and geodisk_python.h."""

from __future__ import annotations

import ctypes
import json
import os
import pathlib
import sys
from ctypes import addressof, byref, c_char_p, c_int32, c_size_t, c_void_p, sizeof
from typing import Any, Mapping

import numpy as np
from numpy.typing import NDArray

from . import _structs as s
from ._errors import BY_STATUS, Error
from ._wording import in_python

_NAMES = {"win32": "geodisk_python.dll", "darwin": "libgeodisk_python.dylib"}


def find(name: str) -> str | None:
    """Path of a file of the package. An editable installation has binaries apart from the modules."""
    for folder in sys.modules[__package__].__path__:
        path = pathlib.Path(folder, name)
        if path.exists():
            return str(path)
    return None


def _load() -> ctypes.CDLL:
    """Loads the library that lies beside this module, or that GEODISK_LIBRARY names."""
    name = _NAMES.get(sys.platform, "libgeodisk_python.so")
    named = os.environ.get("GEODISK_LIBRARY")
    path = named or find(name) or name
    try:
        library = ctypes.CDLL(path)
    except OSError as error:
        hint = "" if named else "; install the package, or let GEODISK_LIBRARY name its library"
        raise ImportError(f"geodisk's library cannot be loaded: {error}{hint}") from None
    if not hasattr(library, "geodisk_python_headers"):
        raise ImportError(f"{path} is not {name}: it has no readers of mesh files")
    library.geodisk_python_headers.restype = c_char_p
    s.declare(library, library.geodisk_python_headers().decode())
    return library


_library = _load()


def ask(name: str, *arguments: Any) -> Any:
    """Calls a function that cannot fail. Takes arrays, structs and objects of the library as pointers."""
    passed = (x.ctypes.data if isinstance(x, np.ndarray) else x for x in arguments)
    return getattr(_library, name)(*passed)


def sampling_version() -> int:
    """The number of the rule that turns a seed into a set."""
    return int(ask("geodisk_sampling_version"))


def version() -> str:
    return str(ask("geodisk_version").decode())


_NO_DEVICE = -4


def call(name: str, *arguments: Any) -> None:
    """Calls a function that can fail; raises what it fails with."""
    error = s.Error()
    status = ask(name, *arguments, error)
    if status != 0:
        kind: str = ask("geodisk_status_name", status).decode()
        element = None if error.element == s.NO_ELEMENT else int(error.element)
        message = error.message.decode("utf-8", "replace")
        if status == _NO_DEVICE:
            (explained,) = run("explain_no_device", message=message)
            message = explained.decode("utf-8", "replace")
        raise BY_STATUS.get(status, Error)(in_python(message), kind, element)


def filled(struct: Any, function: str, *arguments: Any) -> Any:
    """Returns a struct that a function fills."""
    made = struct()
    call(function, *arguments, made)
    return made


class Handle:
    """An object of the library, released with this one."""

    def __init__(self, kind: str, make: str | None = None, *arguments: Any) -> None:
        self._release = getattr(_library, f"geodisk_{kind}_release")
        self.value = c_void_p()
        if make is not None:
            call(make, *arguments, byref(self.value))

    @classmethod
    def of(cls, kind: str, value: int | None) -> Handle:
        """Takes over an object that was made already."""
        made = cls(kind)
        made.value = c_void_p(value)
        return made

    @property
    def _as_parameter_(self) -> c_void_p:
        """What ctypes passes for this object."""
        return self.value

    def abandon(self) -> None:
        """Never releases the object."""
        self.value = c_void_p()

    def __del__(self) -> None:
        value = getattr(self, "value", None)
        if value:
            self._release(value)


def run(
    command: str,
    arrays: Mapping[str, Handle | NDArray[Any] | bytes | None] = {},
    stop: c_int32 | None = None,
    **options: Any,
) -> list[bytes]:
    """Runs a command of geodisk_run_command() with these fields of its task; returns what it makes."""
    task = s.Task(
        options=json.dumps(options).encode(), stop=None if stop is None else addressof(stop)
    )
    for name, one in arrays.items():
        setattr(task, name, one)
    made: list[bytes] = []
    failure: list[BaseException] = []

    def take(data: int, size: int) -> None:
        try:
            made.append(ctypes.string_at(data, size))
        except BaseException as raised:  # ctypes would drop it.
            failure.append(raised)

    call("geodisk_run_command", command.encode(), task, s.TAKE_FN(take))
    if failure:
        raise failure[0]
    return made


def list_devices() -> list[Any]:
    """All Vulkan devices, usable or not; raises NoDevice without loader, driver or device."""
    count = c_size_t()
    call("geodisk_list_devices", None, 0, byref(count))
    infos = (s.DeviceInfo * count.value)()
    if count.value:
        infos[0].struct_size = sizeof(s.DeviceInfo)
        call("geodisk_list_devices", infos, count.value, byref(count))
    return list(infos)
