"""Meshes as arrays, or as other packages have them."""

from __future__ import annotations

import ctypes
import os

import numpy as np

from . import _library as c


def _real(array, name: str) -> np.ndarray:
    """As float64, or float32 where it is that."""
    array = np.asarray(array)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name} has to be of real numbers, not of {array.dtype}")
    if array.dtype not in (np.float64, np.float32):
        array = array.astype(np.float64)
    return array


def _rows(array: np.ndarray) -> np.ndarray:
    """The same, or a copy of it unless the numbers of a row lie side by side and rows follow."""
    fine = array.ndim == 2 and (array.shape[1] < 2 or array.strides[1] == array.itemsize)
    fine = fine and array.strides[0] >= array.shape[1] * array.itemsize
    fine = fine and array.strides[0] % array.itemsize == 0 and array.flags.aligned
    fine = fine and array.dtype.isnative
    return array if fine else np.ascontiguousarray(array, dtype=array.dtype.newbyteorder("="))


def _index_array(faces, name: str = "faces") -> np.ndarray:
    array = np.asarray(faces)
    if array.size == 0 and array.dtype.kind == "f":  # As numpy has [].
        array = array.astype(np.uint32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} have to be of integers, not of {array.dtype}")
    if array.dtype in (np.uint32, np.uint16):
        return np.ascontiguousarray(array, dtype=array.dtype.newbyteorder("="))
    if array.dtype == np.int32 and array.dtype.isnative and array.flags.c_contiguous:
        view = array.view(np.uint32)
        if array.size == 0 or array.min() >= 0:
            return view
    bad = (array < 0) | (array > 2**32 - 1) if array.size else np.zeros(0, bool)
    if bad.any():
        place = np.argwhere(bad)[0]
        raise c.MeshRejected(
            f"{name}[{', '.join(map(str, place))}] is {array[tuple(place)]}, which is no vertex",
            "mesh_rejected",
            int(place[0]),
        )
    return np.ascontiguousarray(array, dtype=np.uint32)


def _read(path) -> tuple:
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


def _arrays_of(source) -> tuple:
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
    all else is copied first. Faces may be oriented either way, share an edge by any number and
    leave borders open.

    Examples
    --------
    >>> import geodisk
    >>> mesh = geodisk.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> mesh.area
    0.5
    """

    def __init__(self, vertices, faces=None, *, edge_lengths=None, weld=False):
        if faces is None:
            vertices, faces = _arrays_of(vertices)
        indices = _index_array(faces)
        if indices.ndim != 2 or indices.shape[1] != 3:
            raise c.InvalidArgument(
                f"faces have the shape {indices.shape}, not (f, 3)", "invalid_argument"
            )
        params = c.MeshParams(
            indices=indices.ctypes.data,
            index_type=c.UINT16 if indices.dtype == np.uint16 else c.UINT32,
            face_count=len(indices),
        )
        if weld is not False:
            params.weld = 1
            params.weld_distance = 0.0 if weld is True else float(weld)
        if edge_lengths is None:
            coordinates = _rows(_real(vertices, "vertices"))
            if coordinates.ndim != 2 or not 2 <= coordinates.shape[1] <= 8:
                raise c.InvalidArgument(
                    f"vertices have the shape {coordinates.shape}, not (v, 2) to (v, 8)",
                    "invalid_argument",
                )
            params.positions = coordinates.ctypes.data
            params.position_type = c.FLOAT32 if coordinates.dtype == np.float32 else c.FLOAT64
            params.dimension = coordinates.shape[1]
            params.vertex_count = len(coordinates)
            params.position_stride = coordinates.strides[0]
        else:
            lengths = np.ascontiguousarray(_real(edge_lengths, "edge_lengths"), np.float64)
            if lengths.shape != indices.shape:
                raise c.InvalidArgument(
                    f"edge_lengths have the shape {lengths.shape}, the faces {indices.shape}",
                    "invalid_argument",
                )
            params.edge_lengths = lengths.ctypes.data
            params.vertex_count = int(vertices)
        self._handle = c.Handle("mesh", "geodisk_mesh_create", ctypes.byref(params))
        self._info = c.MeshInfo()
        c.call("geodisk_mesh_describe", self._handle.value, ctypes.byref(self._info))
        self._vertex_count = params.vertex_count

    @property
    def area(self) -> float:
        """Of the surface."""
        return self._info.area

    @property
    def diagonal(self) -> float:
        """Of the bounding box; 0 for a mesh of lengths."""
        return self._info.diagonal

    @property
    def info(self) -> dict:
        """Counts of vertices, faces, components, boundary edges and the like."""
        return {
            name: getattr(self._info, name)
            for name, _ in c.MeshInfo._fields_
            if name != "struct_size"
        }

    def __repr__(self) -> str:
        return f"<geodisk.Mesh of {self._info.faces} faces, area {self.area:.6g}>"


def radii_of(mesh: Mesh, density) -> c.Handle:
    factors = np.ascontiguousarray(_real(density, "density"))
    factors = factors.astype(factors.dtype.newbyteorder("="), copy=False)
    if factors.shape != (mesh._vertex_count,):
        raise c.InvalidArgument(
            f"density has the shape {factors.shape}, not ({mesh._vertex_count},), "
            "one for each vertex",
            "invalid_argument",
        )
    return c.Handle(
        "radii",
        "geodisk_radii_create",
        mesh._handle.value,
        factors.ctypes.data,
        c.FLOAT32 if factors.dtype == np.float32 else c.FLOAT64,
        len(factors),
    )


def keys_of(mesh: Mesh, face_keys) -> np.ndarray:
    keys = _index_array(face_keys, "face_keys").astype(np.uint32, copy=False)
    if keys.shape != (mesh._info.faces,):
        raise c.InvalidArgument(
            f"face_keys have the shape {keys.shape}, not ({mesh._info.faces},)",
            "invalid_argument",
        )
    if len(np.unique(keys)) != len(keys):
        raise c.InvalidArgument("two face_keys are alike", "invalid_argument")
    return keys
