"""Meshes from files and polygons, as the program reads and splits them."""

from __future__ import annotations

import ctypes
import json
import os
from dataclasses import dataclass
from typing import Any, NamedTuple, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _library as c
from . import _structs as s
from ._attributes import Attribute
from ._polygons import Polygons
from ._values import path_of

_BUILTIN = "builtin:"


@dataclass(frozen=True, eq=False)
class Source:
    """What was read.

    Attributes
    ----------
    vertices : ndarray of float64, shape (v, d)
    triangles : ndarray of uint32, shape (f, 3)
    polygons : ndarray of uint32, shape (f,), or None
        The file's face of each triangle, where the numbers differ.
    attributes : dict of Attribute
    handle : Handle
        Has the memory of these arrays, and warnings of the reader.
    joined : ndarray of uint32, shape (v,), or None
        The lowest vertex that each one is joined with, where any are.
    joined_edges : int
    columns : dict of ndarray of uint32, shape (f,)
    corners : ndarray of uint32, shape (f, 3)
        The triangles before vertices were joined.
    is_y_up : bool
        True for a file of a format in which y points up.
    """

    vertices: NDArray[np.float64]
    triangles: NDArray[np.uint32]
    polygons: NDArray[np.uint32] | None
    attributes: dict[str, Attribute]
    handle: c.Handle
    joined: NDArray[np.uint32] | None
    joined_edges: int
    columns: dict[str, NDArray[np.uint32]]
    corners: NDArray[np.uint32]
    is_y_up: bool

    def leave_out(self, faces: NDArray[np.bool_]) -> None:
        """Makes triangles none, in the memory of the library, as walls do."""
        self.triangles.flags.writeable = True
        self.triangles[faces] = self.triangles[faces, :1]
        self.triangles.flags.writeable = False


class MeshFile(NamedTuple):
    """A mesh file and how it is read."""

    path: str
    weld: bool | float = False
    keep_seams: bool = False
    mesh_format: str | None = None
    allow_outside: bool = False


def absolute(path: str | os.PathLike[str]) -> str:
    """Returns the path of a mesh file that other working folders do not change."""
    name = path_of(path)
    return name if name.startswith(_BUILTIN) else os.path.abspath(name)


def read_file(
    path: str | os.PathLike[str],
    stop: ctypes.c_int32,
    *,
    weld: bool | float = False,
    keep_seams: bool = False,
    attributes: Sequence[str] = (),
    columns: Sequence[str] = (),
    mesh_format: str | None = None,
    allow_outside: bool = False,
    has_normals: bool = False,
    has_uvs: bool = False,
    has_materials: bool = False,
) -> Source:
    """Reads a mesh file with the readers of the program.

    Raises
    ------
    OSError
        For a file that is not there or may not be read.
    MeshRejected
        For a file that holds no mesh, or a damaged one.
    """
    name = path_of(path)
    if not name.startswith(_BUILTIN):
        os.stat(name)  # Raises Python's own errors.
        if not os.access(name, os.R_OK):
            raise PermissionError(13, "Permission denied", name)
    joined = ",".join(columns)  # Which the library splits, and checks each name.
    encoded = (ctypes.c_char_p * len(attributes))(*(one.encode() for one in attributes))
    params = s.SourceParams(
        path=os.fsencode(name),
        attributes=ctypes.addressof(encoded),
        attribute_count=len(attributes),
        columns=joined.encode(),
        mesh_format=None if mesh_format is None else mesh_format.encode(),
        has_normals=has_normals,
        has_uvs=has_uvs,
        has_materials=has_materials,
        allow_outside=allow_outside,
    )
    return _read(params, stop, weld, keep_seams, joined.split(",") if joined else ())


def split(
    vertices: NDArray[Any],
    polygons: Polygons,
    weld: bool | float,
    keep_seams: bool,
    stop: ctypes.c_int32,
) -> Source:
    """Splits polygons into triangles as the readers do."""
    positions = np.ascontiguousarray(vertices, np.float64)
    polygons.check(len(positions))
    params = s.SourceParams(
        positions=positions,
        dimension=positions.shape[1],
        vertex_count=len(positions),
        corners=polygons.corners,
        face_ends=polygons.ends,
        face_count=len(polygons.ends),
    )
    return _read(params, stop, weld, keep_seams)


def _read(
    params: s.SourceParams,
    stop: ctypes.c_int32,
    weld: bool | float,
    keep_seams: bool,
    columns: Sequence[str] = (),
) -> Source:
    params.stop = ctypes.addressof(stop)
    params.keep_seams = keep_seams
    if weld is not False:
        params.weld = 1
        params.weld_distance = 0.0 if weld is True else float(weld)
    handle = c.Handle("source", "geodisk_source_read", ctypes.byref(params))
    told = json.loads(c.run("describe", {"source": handle})[0])
    count = told["triangle_count"]

    def view(address: int, *shape: int, dtype: Any = np.uint32) -> NDArray[Any] | None:
        return view_of(address, shape, handle, dtype) if address else None

    polygons = view(told["polygons"], count)
    attributes = {}
    for one in told["attributes"]:
        shape = (one["count"],) if one["components"] == 1 else (one["count"], one["components"])
        attributes[one["name"]] = Attribute(
            values=view_of(one["values"], shape, handle, np.float64),
            corners=view(one["corners"], count, 3),
            of_vertices=one["of_vertices"],
            is_whole=one["is_whole"],
            is_light=one["is_light"],
            polygons=polygons,
        )
    return Source(
        vertices=view_of(
            told["positions"], (told["vertex_count"], told["dimension"]), handle, np.float64
        ),
        triangles=view_of(told["triangles"], (count, 3), handle),
        polygons=polygons,
        attributes=attributes,
        handle=handle,
        joined=view(told["joined"], told["vertex_count"]),
        joined_edges=told["joined_edges"],
        columns={name: view_of(at, (count,), handle) for name, at in zip(columns, told["columns"])},
        corners=view_of(told["corners"], (count, 3), handle),
        is_y_up=told["is_y_up"],
    )


def view_of(
    address: int | None, shape: tuple[int, ...], handle: c.Handle, dtype: Any = np.uint32
) -> NDArray[Any]:
    """Returns the memory as an array that cannot be written, and keeps `handle`."""
    size = int(np.prod(shape)) * np.dtype(dtype).itemsize
    if address is None or size == 0:
        return np.empty(shape, dtype)
    memory: Any = (ctypes.c_char * size).from_address(address)
    memory.handle = handle
    array = np.frombuffer(memory, dtype).reshape(shape)
    array.flags.writeable = False
    return array
