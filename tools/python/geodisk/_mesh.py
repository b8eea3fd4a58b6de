"""Meshes as arrays, or as other packages have them."""

from __future__ import annotations

import ctypes
import operator
import os
from dataclasses import dataclass
from typing import Any, Protocol, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _library as c
from ._arrays import indices, real, rows


class HasFaces(Protocol):
    """A mesh as trimesh has it."""

    vertices: Any
    faces: Any


class HasTriangles(Protocol):
    """A mesh as Open3D has it."""

    vertices: Any
    triangles: Any


class HasTensors(Protocol):
    """A mesh as Open3D has it in tensors."""

    vertex: Any
    triangle: Any


#: What brings its faces.
MeshLike = Union["Mesh", HasFaces, HasTriangles, HasTensors, str, "os.PathLike[str]"]


def _read(path: str | os.PathLike[str]) -> tuple[Any, Any]:
    """Vertices and faces of a file, by trimesh."""
    if not os.path.exists(path):
        raise FileNotFoundError(f"{os.fspath(path)}: no such file")
    try:
        import trimesh
    except ImportError:
        raise ImportError(
            "geodisk reads meshes from files by trimesh, which is not installed "
            "(pip install trimesh)"
        ) from None
    loaded = trimesh.load(path, process=False, force="mesh")
    return loaded.vertices, loaded.faces


def is_mesh(source: Any) -> bool:
    """Whether it brings its faces, rather than being coordinates."""
    return isinstance(source, (Mesh, str, os.PathLike)) or any(
        hasattr(source, name) for name in ("vertex", "vertices")
    )


def _arrays_of(source: Any) -> tuple[Any, Any]:
    """Vertices and faces of what is not an array."""
    if isinstance(source, (str, os.PathLike)):
        return _read(source)
    if hasattr(source, "vertex") and hasattr(source, "triangle"):  # Open3D's tensor meshes.
        return source.vertex.positions.numpy(), source.triangle.indices.numpy()
    for name in ("faces", "triangles"):  # trimesh; Open3D.
        if hasattr(source, "vertices") and hasattr(source, name):
            return np.asarray(source.vertices), np.asarray(getattr(source, name))
    raise TypeError(
        "a mesh is vertices and faces, a geodisk.Mesh, a trimesh.Trimesh, an Open3D mesh or a path, "
        f"not {type(source).__name__}"
    )


@dataclass(frozen=True, eq=False)
class Surface:
    """What a mesh was made of, as it was given: arrays are kept by reference."""

    vertices: Any  #: Or their number, where there are lengths.
    faces: Any
    edge_lengths: Any = None
    weld: bool | float = False

    def indices(self) -> NDArray[Any]:
        """The faces, of uint32 or uint16."""
        array = indices(self.faces, "faces", c.MeshRejected)
        if array.ndim != 2 or array.shape[1] != 3:
            raise c.invalid(f"faces have the shape {array.shape}, not (f, 3)")
        return array

    def coordinates(self) -> NDArray[Any]:
        """The vertices, of float64 or float32."""
        array = rows(real(self.vertices, "vertices"))
        if array.ndim != 2 or not 2 <= array.shape[1] <= 8:
            raise c.invalid(f"vertices have the shape {array.shape}, not (v, 2) to (v, 8)")
        return array

    def lengths(self) -> NDArray[np.float64]:
        """Those of the edges, by face."""
        array = np.ascontiguousarray(real(self.edge_lengths, "edge_lengths"), np.float64)
        shape = np.shape(self.faces)
        if array.shape != shape:
            raise c.invalid(f"edge_lengths have the shape {array.shape}, the faces {shape}")
        return array

    def dimension(self) -> int:
        """Coordinates of each vertex, 0 without any."""
        return 0 if self.edge_lengths is not None else int(self.coordinates().shape[1])

    def vertex_count(self) -> int:
        if self.edge_lengths is not None:
            return _vertex_number(self.vertices)
        return len(self.coordinates())

    def factors(self, density: ArrayLike) -> NDArray[Any]:
        """One of float64 or float32 for each vertex."""
        array = np.ascontiguousarray(real(density, "density"))
        if array.shape != (self.vertex_count(),):
            raise c.invalid(
                f"density has the shape {array.shape}, not ({self.vertex_count()},), "
                "one for each vertex"
            )
        return array.astype(array.dtype.newbyteorder("="), copy=False)


class Mesh:
    """A triangle mesh, prepared for any number of runs.

    Parameters
    ----------
    vertices : array_like of float, shape (v, d), or a mesh
        Coordinates, d from 2 to 8, in any unit, which is that of all distances. Or a
        ``trimesh.Trimesh``, an Open3D mesh or the path of a file, which bring their faces.
    faces : array_like of int, shape (f, 3)
        Vertices of each triangle.
    edge_lengths : array_like of float, shape (f, 3), optional
        The surface by its lengths instead of its coordinates: of each face from its first corner
        to the second, to the third and back. ``vertices`` is then their number.
    weld : bool or float
        Join vertices that lie in one place, or no farther apart than so much.

    Raises
    ------
    MeshRejected
        Where the mesh cannot be sampled; ``element`` is the face or vertex.
    TypeError, InvalidArgument
        For arrays of another kind or shape.

    Notes
    -----
    float32 and float64 coordinates are read where they are, also with other columns beside them;
    all else is copied first. The mesh and samples on it refer to the arrays, for :func:`verify` and
    the like: change copies of them. Faces may be oriented either way, share an edge by any number
    and leave borders open.

    Examples
    --------
    >>> import geodisk
    >>> mesh = geodisk.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> mesh.area
    0.5
    """

    def __init__(
        self,
        vertices: ArrayLike | MeshLike,
        faces: ArrayLike | None = None,
        *,
        edge_lengths: ArrayLike | None = None,
        weld: bool | float = False,
    ) -> None:
        if faces is None:
            vertices, faces = _arrays_of(vertices)
        self._surface = surface = Surface(vertices, faces, edge_lengths, weld)
        corners = surface.indices()
        params = c.MeshParams(
            indices=corners.ctypes.data,
            index_type=c.UINT16 if corners.dtype == np.uint16 else c.UINT32,
            face_count=len(corners),
        )
        if weld is not False:
            params.weld = 1
            params.weld_distance = 0.0 if weld is True else float(weld)
        if edge_lengths is None:
            coordinates = surface.coordinates()
            params.positions = coordinates.ctypes.data
            params.position_type = c.FLOAT32 if coordinates.dtype == np.float32 else c.FLOAT64
            params.dimension = coordinates.shape[1]
            params.vertex_count = len(coordinates)
            params.position_stride = coordinates.strides[0]
        else:
            lengths = surface.lengths()
            params.edge_lengths = lengths.ctypes.data
            params.vertex_count = surface.vertex_count()
        self._handle = c.Handle("mesh", "geodisk_mesh_create", ctypes.byref(params))
        self._info = c.MeshInfo()
        c.call("geodisk_mesh_describe", self._handle.value, ctypes.byref(self._info))

    @property
    def area(self) -> float:
        """Of the surface."""
        return float(self._info.area)

    @property
    def diagonal(self) -> float:
        """Of the bounding box; 0 for a mesh of lengths."""
        return float(self._info.diagonal)

    @property
    def info(self) -> dict[str, int | float]:
        """Counts of vertices, faces, components, boundary edges and the like."""
        return {
            name: getattr(self._info, name)
            for name, _ in c.MeshInfo._fields_
            if name != "struct_size"
        }

    def __repr__(self) -> str:
        return f"<geodisk.Mesh of {self._info.faces} faces, area {self.area:.6g}>"


def _vertex_number(value: Any) -> int:
    number = operator.index(value)
    if not 0 <= number <= 2**32 - 1:
        raise c.invalid(f"there are {number} vertices, not from 0 to {2**32 - 1}")
    return number


def mesh_of(
    vertices: ArrayLike | MeshLike,
    faces: ArrayLike | None,
    edge_lengths: ArrayLike | None,
    weld: bool | float,
) -> Mesh:
    """The mesh that the arguments of a function name."""
    if not isinstance(vertices, Mesh):
        return Mesh(vertices, faces, edge_lengths=edge_lengths, weld=weld)
    if faces is not None or edge_lengths is not None or weld is not False:
        raise TypeError("a geodisk.Mesh has its faces, lengths and welds already")
    return vertices


def radii_of(mesh: Mesh, density: ArrayLike) -> c.Handle:
    factors = mesh._surface.factors(density)
    return c.Handle(
        "radii",
        "geodisk_radii_create",
        mesh._handle.value,
        factors.ctypes.data,
        c.FLOAT32 if factors.dtype == np.float32 else c.FLOAT64,
        len(factors),
    )


def keys_of(mesh: Mesh, face_keys: ArrayLike) -> NDArray[np.uint32]:
    keys = indices(face_keys, "face_keys").astype(np.uint32, copy=False)
    if keys.shape != (mesh._info.faces,):
        raise c.invalid(f"face_keys have the shape {keys.shape}, not ({mesh._info.faces},)")
    if len(np.unique(keys)) != len(keys):
        raise c.invalid("two face_keys are alike")
    return keys
