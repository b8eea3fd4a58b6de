"""The functions and structs of geodisk/geodisk.h, by ctypes."""

from __future__ import annotations

import ctypes
import ctypes.util
import os
import pathlib
import sys
from ctypes import (
    POINTER,
    Structure,
    byref,
    c_char,
    c_char_p,
    c_double,
    c_int32,
    c_size_t,
    c_uint8,
    c_uint32,
    c_uint64,
    c_void_p,
    sizeof,
)
from typing import Any, Iterator

FLOAT64, FLOAT32, UINT32, UINT16 = range(4)
FACE, BARYCENTRIC, POSITION, NORMAL, RADIUS, PART = range(6)
METRICS = {"geodesic": 0, "euclidean": 1, "approximate": 2}
NO_ELEMENT = 2**64 - 1


class _Sized(Structure):
    """A struct that begins with its size."""

    def __init__(self, **fields: Any) -> None:
        super().__init__(struct_size=sizeof(type(self)), **fields)


class CError(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("status", c_int32),
        ("vk_result", c_int32),
        ("element", c_uint64),
        ("message", c_char * 1024),
    ]


class DeviceInfo(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("is_usable", c_int32),
        ("type", c_uint32),
        ("vendor_id", c_uint32),
        ("device_id", c_uint32),
        ("api_version", c_uint32),
        ("driver_version", c_uint32),
        ("compute_queue_family", c_uint32),
        ("graphics_queue_family", c_uint32),
        ("memory_bytes", c_uint64),
        ("uuid", c_uint8 * 16),
        ("name", c_char * 256),
        ("driver", c_char * 512),
        ("reasons", c_char * 1024),
    ]


class DeviceOptions(_Sized):
    _fields_ = [("struct_size", c_size_t), ("device", c_char_p), ("validation", c_int32)]


class MeshParams(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("positions", c_void_p),
        ("position_type", c_int32),
        ("dimension", c_uint32),
        ("vertex_count", c_size_t),
        ("position_stride", c_size_t),
        ("indices", c_void_p),
        ("index_type", c_int32),
        ("face_count", c_size_t),
        ("index_stride", c_size_t),
        ("edge_lengths", c_void_p),
        ("weld", c_int32),
        ("weld_distance", c_double),
        ("most_threads", c_uint32),
    ]


class MeshInfo(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("dimension", c_uint32),
        ("vertices", c_uint64),
        ("faces", c_uint64),
        ("components", c_uint64),
        ("boundary_edges", c_uint64),
        ("coinciding_border_edges", c_uint64),
        ("nonmanifold_edges", c_uint64),
        ("repeated_index_faces", c_uint64),
        ("zero_area_faces", c_uint64),
        ("merged_vertices", c_uint64),
        ("area", c_double),
        ("diagonal", c_double),
        ("longest_edge", c_double),
    ]


class SurfaceParams(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("min_distance", c_double),
        ("seed", c_uint64),
        ("pool_ratio", c_double),
        ("throws", c_uint32),
        ("stop_count", c_uint32),
        ("radii", c_void_p),
        ("face_keys", c_void_p),
        ("metric", c_int32),
    ]


class BoxParams(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("extents", POINTER(c_double)),
        ("dimension", c_uint32),
        ("is_periodic", c_int32),
        ("min_distance", c_double),
        ("seed", c_uint64),
        ("pool_ratio", c_double),
        ("throws", c_uint32),
        ("stop_count", c_uint32),
    ]


class SamplerOptions(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("device_bytes", c_uint64),
        ("submission_seconds", c_double),
        ("stall_seconds", c_double),
        ("count_calls", c_int32),
    ]


class Progress(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("decided", c_uint32),
        ("candidates", c_uint32),
        ("accepted", c_uint32),
        ("disks", c_uint32),
        ("windows", c_uint64),
    ]


class Report(_Sized):
    _fields_ = [
        ("struct_size", c_size_t),
        ("samples", c_uint64),
        ("candidates", c_uint32),
        ("iterations", c_uint32),
        ("dispatches", c_uint32),
        ("disks", c_uint32),
        ("windows", c_uint64),
        ("device_bytes", c_uint64),
        ("min_distance", c_double),
        ("guard", c_double),
        ("rho", c_double),
        ("compile_seconds", c_double),
        ("upload_seconds", c_double),
        ("sample_seconds", c_double),
        ("readback_seconds", c_double),
        ("calls", c_uint64 * 10),
    ]


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
    "geodisk_domain_surface": [c_void_p, POINTER(SurfaceParams), _HANDLE],
    "geodisk_domain_box": [POINTER(BoxParams), _HANDLE],
    "geodisk_distance_for_count": [c_void_p, c_void_p, c_double, POINTER(c_double)],
    "geodisk_box_distance_for_count": [POINTER(BoxParams), c_double, POINTER(c_double)],
    "geodisk_sampler_create": [c_void_p, POINTER(SamplerOptions), _HANDLE],
    "geodisk_start": [c_void_p, c_void_p],
    "geodisk_poll": [c_void_p, c_uint32, _HANDLE],
    "geodisk_sampler_progress": [c_void_p, POINTER(Progress)],
    "geodisk_samples_copy": [c_void_p, c_int32, c_int32, c_void_p, c_size_t, c_size_t],
    "geodisk_samples_report": [c_void_p, POINTER(Report)],
    "geodisk_count_search_create": [c_double, _HANDLE],
    "geodisk_count_search_note": [
        c_void_p,
        c_double,
        c_uint64,
        POINTER(c_double),
        POINTER(c_int32),
    ],
}
_RELEASES = ["device", "mesh", "radii", "domain", "sampler", "samples", "count_search"]


class Error(Exception):
    """A call of geodisk failed.

    Attributes
    ----------
    status : str
        What kind of failure: ``"invalid_argument"``, ``"mesh_rejected"``, ``"no_device"`` ...
    element : int or None
        The face or vertex at fault, where one is.
    """

    def __init__(
        self, message: str, status: str = "internal", element: int | None = None
    ) -> None:
        super().__init__(message)
        self.status = status
        self.element = element


class InvalidArgument(Error, ValueError):
    """A value is out of its range, or arguments contradict each other."""


class MeshRejected(Error, ValueError):
    """The mesh cannot be sampled; ``element`` names the face or vertex."""


class NoDevice(Error):
    """There is no Vulkan loader, driver or device that can run geodisk."""


class OutOfMemory(Error, MemoryError):
    """The host's or the device's memory does not suffice."""


class DeviceLost(Error):
    """The device stopped to work. The next call opens it anew."""


class Cancelled(Error):
    """A progress callback asked to stop, or a signal ended the program ``geodisk``."""


class NoProgram(Error):
    """The program ``geodisk``, which some functions run, is not there or of another version."""


_ERRORS = {
    -1: InvalidArgument,
    -2: MeshRejected,
    -3: NoDevice,
    -4: NoDevice,
    -5: OutOfMemory,
    -6: OutOfMemory,
    -7: OutOfMemory,
    -8: DeviceLost,
    -9: Cancelled,
    -11: OutOfMemory,
}


def _candidates() -> Iterator[str]:
    """Where the library may be, in the order of preference."""
    if os.environ.get("GEODISK_LIBRARY"):
        yield os.environ["GEODISK_LIBRARY"]
        return
    names = {"win32": ["geodisk.dll", "libgeodisk.dll"], "darwin": ["libgeodisk.0.dylib"]}.get(
        sys.platform, ["libgeodisk.so.0"]
    )
    here = pathlib.Path(__file__).parent
    for name in names:
        if (here / name).exists():
            yield str(here / name)
    yield from names
    found = ctypes.util.find_library("geodisk")
    if found:
        yield found


def _load() -> ctypes.CDLL:
    tried = []
    for path in _candidates():
        try:
            return ctypes.CDLL(path)
        except OSError as error:
            tried.append(f"{path}: {error}")
    raise ImportError("geodisk's library cannot be loaded: " + "; ".join(tried))


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
_library.geodisk_cancel.argtypes = [c_void_p]
_library.geodisk_cancel.restype = None
_library.geodisk_samples_count.argtypes = [c_void_p]
_library.geodisk_samples_count.restype = c_size_t
_library.geodisk_samples_width.argtypes = [c_void_p, c_int32]
_library.geodisk_samples_width.restype = c_uint32


def version() -> str:
    name: bytes = _library.geodisk_version()
    return name.decode()


def call(name: str, *arguments: Any) -> None:
    """Calls a function that can fail; raises what it fails with."""
    error = CError()
    status = getattr(_library, name)(*arguments, byref(error))
    if status != 0:
        kind: str = _library.geodisk_status_name(status).decode()
        element = None if error.element == NO_ELEMENT else int(error.element)
        message = error.message.decode("utf-8", "replace")
        raise _ERRORS.get(status, Error)(message, kind, element)


def cancel(sampler: c_void_p) -> None:
    _library.geodisk_cancel(sampler)


def samples_count(samples: c_void_p) -> int:
    return int(_library.geodisk_samples_count(samples))


def samples_width(samples: c_void_p, attribute: int) -> int:
    return int(_library.geodisk_samples_width(samples, attribute))


def invalid(message: str) -> InvalidArgument:
    """What to raise for an argument that the library does not see."""
    return InvalidArgument(message, "invalid_argument")


class Handle:
    """An object of the library, released with this one."""

    def __init__(self, kind: str, make: str | None = None, *arguments: Any) -> None:
        self._release = getattr(_library, f"geodisk_{kind}_release")
        self.value = c_void_p()
        if make is not None:
            call(make, *arguments, byref(self.value))

    def __del__(self) -> None:
        value, self.value = getattr(self, "value", None), c_void_p()
        if value:
            self._release(value)
