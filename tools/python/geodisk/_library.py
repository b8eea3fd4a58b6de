"""The library of the package, by ctypes: geodisk/geodisk.h and geodisk_python.h."""

from __future__ import annotations

import ctypes
import json
import os
import sys
from ctypes import POINTER, byref, c_char_p, c_double, c_int32, c_size_t, c_uint32, c_void_p, pointer, sizeof
from typing import Any, Mapping

import numpy as np
from numpy.typing import NDArray

from . import _place
from ._errors import BY_STATUS, Error
from ._structs import (
    NO_ELEMENT,
    PROGRESS_FN,
    TAKE_FN,
    BoxRequest,
    CellArrays,
    CellParams,
    CError,
    DeviceInfo,
    DeviceOptions,
    DistanceParams,
    FarthestInfo,
    FarthestParams,
    MeshInfo,
    MeshParams,
    MeshRequest,
    NeighbourArrays,
    NeighbourParams,
    PathParams,
    PathPoint,
    Progress,
    RecordParams,
    Report,
    Rule,
    SamplerOptions,
    SourceArrays,
    SourceAttribute,
    SourceParams,
    SurfaceParams,
    Task,
    UpdateInfo,
)
from ._wording import in_python

# Name, types of the arguments before the error, and whether it returns a status.
_HANDLE = POINTER(c_void_p)
_FALLIBLE: dict[str, list[Any]] = {
    "geodisk_list_devices": [POINTER(DeviceInfo), c_size_t, POINTER(c_size_t)],
    "geodisk_device_open": [POINTER(DeviceOptions), _HANDLE],
    "geodisk_device_describe": [c_void_p, POINTER(DeviceInfo)],
    "geodisk_mesh_create": [POINTER(MeshParams), _HANDLE],
    "geodisk_mesh_save": [c_void_p, c_void_p, c_size_t, POINTER(c_size_t)],
    "geodisk_mesh_load": [c_char_p, c_size_t, _HANDLE],
    "geodisk_mesh_describe": [c_void_p, POINTER(MeshInfo)],
    "geodisk_radii_create": [c_void_p, c_void_p, c_int32, c_size_t, _HANDLE],
    "geodisk_density_create": [c_void_p, c_void_p, c_int32, c_size_t, _HANDLE],
    "geodisk_domain_surface": [c_void_p, POINTER(SurfaceParams), _HANDLE],
    "geodisk_distance_for_count": [c_void_p, c_void_p, c_void_p, c_double, POINTER(c_double)],
    "geodisk_sampler_create": [c_void_p, POINTER(SamplerOptions), _HANDLE],
    "geodisk_request_rule": [c_size_t, POINTER(Rule)],
    "geodisk_start": [c_void_p, c_void_p],
    "geodisk_start_requests": [c_void_p, POINTER(MeshRequest), c_size_t],
    "geodisk_start_box_request": [c_void_p, POINTER(BoxRequest)],
    "geodisk_poll": [c_void_p, c_uint32, _HANDLE],
    "geodisk_sampler_progress": [c_void_p, POINTER(Progress)],
    "geodisk_find_neighbours": [
        c_void_p,
        c_void_p,
        POINTER(NeighbourParams),
        PROGRESS_FN,
        c_void_p,
        _HANDLE,
    ],
    "geodisk_farthest_order": [
        c_void_p,
        c_void_p,
        POINTER(FarthestParams),
        PROGRESS_FN,
        c_void_p,
        c_void_p,
        c_void_p,
        POINTER(FarthestInfo),
    ],
    "geodisk_geodesic_distances": [
        c_void_p,
        POINTER(DistanceParams),
        PROGRESS_FN,
        c_void_p,
        c_void_p,
        c_void_p,
    ],
    "geodisk_geodesic_path": [c_void_p, POINTER(PathParams), _HANDLE],
    "geodisk_updater_create_edited": [
        c_void_p,
        POINTER(SurfaceParams),
        c_void_p,
        POINTER(SurfaceParams),
        c_void_p,
        c_void_p,
        c_size_t,
        _HANDLE,
    ],
    "geodisk_update": [
        c_void_p,
        c_void_p,
        c_void_p,
        POINTER(SurfaceParams),
        c_void_p,
        c_size_t,
        PROGRESS_FN,
        c_void_p,
        POINTER(UpdateInfo),
    ],
    "geodisk_updater_samples": [c_void_p, _HANDLE],
    "geodisk_updater_frame": [c_void_p, c_char_p],
    "geodisk_job_frame_of": [c_void_p, POINTER(SurfaceParams), c_char_p],
    "geodisk_neighbours_describe": [c_void_p, POINTER(NeighbourArrays)],
    "geodisk_find_cells": [
        c_void_p,
        c_void_p,
        POINTER(CellParams),
        PROGRESS_FN,
        c_void_p,
        _HANDLE,
    ],
    "geodisk_cells_describe": [c_void_p, POINTER(CellArrays)],
    "geodisk_nearest_create": [
        c_void_p,
        c_void_p,
        POINTER(CellParams),
        PROGRESS_FN,
        c_void_p,
        _HANDLE,
    ],
    "geodisk_samples_copy": [c_void_p, c_int32, c_int32, c_void_p, c_size_t, c_size_t],
    "geodisk_samples_report": [c_void_p, POINTER(Report)],
    "geodisk_source_read": [POINTER(SourceParams), _HANDLE],
    "geodisk_source_describe": [c_void_p, POINTER(SourceArrays)],
    "geodisk_source_get_attribute": [c_void_p, c_size_t, POINTER(SourceAttribute)],
    "geodisk_source_column": [c_void_p, c_size_t, POINTER(POINTER(c_uint32))],
    "geodisk_source_record": [c_void_p, POINTER(RecordParams)],
    "geodisk_run_command": [c_char_p, POINTER(Task), TAKE_FN],
}
_RELEASES = [
    "device",
    "mesh",
    "radii",
    "domain",
    "sampler",
    "samples",
    "neighbours",
    "cells",
    "nearest",
    "path",
    "source",
    "updater",
]


_NAMES = {"win32": "geodisk_python.dll", "darwin": "libgeodisk_python.dylib"}


def _load() -> ctypes.CDLL:
    """Loads the library that lies beside this module, or that GEODISK_LIBRARY names."""
    name = _NAMES.get(sys.platform, "libgeodisk_python.so")
    named = os.environ.get("GEODISK_LIBRARY")
    path = named or _place.find(name) or name
    try:
        library = ctypes.CDLL(path)
    except OSError as error:
        hint = "" if named else "; install the package, or let GEODISK_LIBRARY name its library"
        raise ImportError(f"geodisk's library cannot be loaded: {error}{hint}") from None
    if not hasattr(library, "geodisk_source_read"):
        raise ImportError(f"{path} is not {name}: it has no readers of mesh files")
    for function in _FALLIBLE:
        if not hasattr(library, function):
            raise ImportError(f"{path} is of another version of geodisk: it has no {function}")
    return library


_library = _load()
for _name, _arguments in _FALLIBLE.items():
    _function = getattr(_library, _name)
    _function.argtypes = _arguments + [POINTER(CError)]
    _function.restype = c_int32
for _name in _RELEASES:
    getattr(_library, f"geodisk_{_name}_release").argtypes = [c_void_p]
    getattr(_library, f"geodisk_{_name}_release").restype = None
_library.geodisk_status_name.argtypes = [c_int32]
_library.geodisk_status_name.restype = c_char_p
_library.geodisk_version.restype = c_char_p
_library.geodisk_sampling_version.restype = c_uint32
_library.geodisk_cancel.argtypes = [c_void_p]
_library.geodisk_cancel.restype = None
_library.geodisk_radii_min_factor.argtypes = [c_void_p]
_library.geodisk_radii_min_factor.restype = c_double
_library.geodisk_nearest_error.argtypes = [c_void_p]
_library.geodisk_nearest_error.restype = c_double
_library.geodisk_path_length.argtypes = [c_void_p]
_library.geodisk_path_length.restype = c_double
_library.geodisk_path_points.argtypes = [c_void_p, POINTER(c_size_t)]
_library.geodisk_path_points.restype = c_void_p
_library.geodisk_samples_count.argtypes = [c_void_p]
_library.geodisk_samples_count.restype = c_size_t
_library.geodisk_skip_exit_handlers.argtypes = []
_library.geodisk_skip_exit_handlers.restype = None
_library.geodisk_samples_width.argtypes = [c_void_p, c_int32]
_library.geodisk_samples_width.restype = c_uint32


def sampling_version() -> int:
    """The number of the rule that turns a seed into a set."""
    number: int = _library.geodisk_sampling_version()
    return number


def version() -> str:
    name: bytes = _library.geodisk_version()
    return name.decode()


_NO_DEVICE = -4


def call(name: str, *arguments: Any) -> None:
    """Calls a function that can fail; raises what it fails with."""
    error = CError()
    status = getattr(_library, name)(*arguments, byref(error))
    if status != 0:
        kind: str = _library.geodisk_status_name(status).decode()
        element = None if error.element == NO_ELEMENT else int(error.element)
        message = error.message.decode("utf-8", "replace")
        if status == _NO_DEVICE:
            (explained,) = run("explain_no_device", message=message)
            message = explained.decode("utf-8", "replace")
        raise BY_STATUS.get(status, Error)(in_python(message), kind, element)


def cancel(sampler: c_void_p) -> None:
    _library.geodisk_cancel(sampler)


def radii_min_factor(radii: c_void_p) -> float:
    return float(_library.geodisk_radii_min_factor(radii))


def path_length(path: Handle) -> float:
    return float(_library.geodisk_path_length(path.value))


def path_points(path: Handle) -> NDArray[Any]:
    """The points of a path, with fields face and weights."""
    count = c_size_t()
    address = _library.geodisk_path_points(path.value, byref(count))
    data = ctypes.string_at(address, count.value * sizeof(PathPoint))
    return np.frombuffer(data, np.dtype(PathPoint))


def nearest_error(nearest: c_void_p) -> float:
    return float(_library.geodisk_nearest_error(nearest))


def samples_count(samples: c_void_p) -> int:
    return int(_library.geodisk_samples_count(samples))


def skip_exit_handlers() -> None:
    """Lets this process end without the handlers that were registered for its end so far."""
    _library.geodisk_skip_exit_handlers()


def samples_width(samples: c_void_p, attribute: int) -> int:
    return int(_library.geodisk_samples_width(samples, attribute))


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

    def abandon(self) -> None:
        """Never releases the object."""
        self.value = c_void_p()

    def __del__(self) -> None:
        value, self.value = getattr(self, "value", None), c_void_p()
        if value:
            self._release(value)


def run(
    command: str,
    arrays: Mapping[str, Handle | NDArray[Any] | None] = {},
    stop: c_int32 | None = None,
    **options: Any,
) -> list[bytes]:
    """Runs a command of geodisk_run_command() with these fields of its task; returns what it makes."""
    task = Task(options=json.dumps(options).encode(), stop=None if stop is None else pointer(stop))
    for name, one in arrays.items():
        if one is not None:
            setattr(task, name, one.value if isinstance(one, Handle) else one.ctypes.data)
    made: list[bytes] = []
    take = TAKE_FN(lambda data, size: made.append(ctypes.string_at(data, size)))
    call("geodisk_run_command", command.encode(), byref(task), take)
    return made


def list_devices() -> list[DeviceInfo]:
    """All Vulkan devices, usable or not; raises NoDevice without loader, driver or device."""
    count = c_size_t()
    call("geodisk_list_devices", None, 0, byref(count))
    infos = (DeviceInfo * count.value)()
    if count.value:
        infos[0].struct_size = sizeof(DeviceInfo)
        call("geodisk_list_devices", infos, count.value, byref(count))
    return list(infos)
