"""Meshes from files and polygons, as the program reads and splits them."""

from __future__ import annotations

import ctypes
import dataclasses
import json
import os
from typing import Any, NamedTuple, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _library as c
from . import _structs as s
from ._attributes import Attribute
from ._background import interruptible
from ._polygons import Polygons
from ._surface import Surface


class Source(NamedTuple):
    """A surface, and what was read with it."""

    surface: Surface
    handle: c.Handle | None = None  #: The reader's, with its warnings and the memory of the surface.
    joined_edges: int = 0

    def changed(self, **fields: Any) -> Source:
        """Returns the same with other fields of the surface."""
        return self._replace(surface=dataclasses.replace(self.surface, **fields))

    def leave_out(self, faces: NDArray[np.bool_]) -> None:
        """Makes triangles none, in the memory of the library, as walls do."""
        triangles = self.surface.faces
        triangles.flags.writeable = True
        triangles[faces] = triangles[faces, :1]
        triangles.flags.writeable = False


class MeshFile(NamedTuple):
    """A mesh file and how it is read."""

    path: str
    weld: bool | float = False
    keep_seams: bool = False
    mesh_format: str | None = None
    allow_outside: bool = False

    def is_builtin(self) -> bool:
        return self.path.startswith("builtin:")

    def absolute(self) -> MeshFile:
        """Returns the same file, for other working folders too."""
        return self if self.is_builtin() else self._replace(path=os.path.abspath(self.path))


def read_file(
    file: MeshFile,
    *,
    attributes: Sequence[str] = (),
    columns: Sequence[str] = (),
    has_normals: bool = False,
    has_uvs: bool = False,
    has_materials: bool = False,
) -> Source:
    """Reads a mesh file with the readers of the program. Raises Python's own errors if it cannot be read."""
    if not file.is_builtin():
        os.stat(file.path)
        if not os.access(file.path, os.R_OK):
            raise PermissionError(13, "Permission denied", file.path)
    joined = ",".join(columns)  # Which the library splits, and checks each name.
    encoded = (ctypes.c_char_p * len(attributes))(*(one.encode() for one in attributes))
    params = s.SourceParams(
        path=os.fsencode(file.path),
        attributes=encoded,
        attribute_count=len(attributes),
        columns=joined.encode(),
        mesh_format=None if file.mesh_format is None else file.mesh_format.encode(),
        has_normals=has_normals,
        has_uvs=has_uvs,
        has_materials=has_materials,
        allow_outside=file.allow_outside,
    )
    return _read(params, file.weld, file.keep_seams, joined.split(",") if joined else ())


def split(vertices: NDArray[Any], polygons: Polygons, weld: bool | float, keep_seams: bool) -> Source:
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
    return _read(params, weld, keep_seams)


def _read(
    params: s.SourceParams,
    weld: bool | float,
    keep_seams: bool,
    columns: Sequence[str] = (),
) -> Source:
    params.keep_seams = keep_seams
    if weld is not False:
        params.weld = 1
        params.weld_distance = 0.0 if weld is True else float(weld)

    def read(stop: ctypes.c_int32) -> c.Handle:
        params.stop = ctypes.addressof(stop)
        return c.Handle("source", "geodisk_source_read", params)

    handle = interruptible(read)
    told = json.loads(c.run("describe", {"source": handle})[0])
    count, vertex_count = told["triangle_count"], told["vertex_count"]

    def view(address: int, *shape: int, dtype: Any = np.uint32) -> Any:
        return view_of(address, shape, handle, dtype) if address else None

    polygons, joined = view(told["polygons"], count), view(told["joined"], vertex_count)
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
    surface = Surface(
        view_of(told["positions"], (vertex_count, told["dimension"]), handle, np.float64),
        view_of(told["triangles"], (count, 3), handle),
        weld=weld,
        keep_seams=keep_seams,
        is_joined=True,
        polygons=polygons,
        attributes=attributes,
        joined=joined,
        columns={name: view_of(at, (count,), handle) for name, at in zip(columns, told["columns"])},
        corners=None if joined is None else view_of(told["corners"], (count, 3), handle),
        is_y_up=told["is_y_up"],
    )
    return Source(surface, handle, told["joined_edges"])


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
