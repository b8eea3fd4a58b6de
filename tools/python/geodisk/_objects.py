"""Vertices and faces of meshes that other packages made. None of them is imported here."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _errors as e
from ._arrays import unreadable
from ._polygons import Polygons, from_lists, from_padded, from_rows, from_strips, joined

_WHAT_IS_TAKEN = (
    "a mesh is vertices and faces, a path, or a mesh of geodisk, trimesh, Open3D, PyVista, meshio or "
    "vedo"
)

# Corners of the cells of VTK and meshio that are faces. Others of higher order have the corners first.
_FACE_CELLS = {
    "triangle": 3,
    "quad": 4,
    "triangle6": 3,
    "triangle7": 3,
    "quad8": 4,
    "quad9": 4,
}


_VTK_FACES = {5, 7, 9}  # VTK_TRIANGLE, VTK_POLYGON, VTK_QUAD.


def arrays_of(source: Any) -> tuple[Any, Any]:
    """Returns vertices and faces; faces are array_like or Polygons.

    Raises
    ------
    TypeError
        For what is no mesh.
    """
    for has, convert in _KINDS:
        if has(source):
            return convert(source)
    if isinstance(source, (np.ndarray, list, tuple)):
        raise TypeError("faces are missing: a mesh is vertices and faces, or brings its faces")
    raise TypeError(f"{_WHAT_IS_TAKEN}, not {type(source).__name__}")


def is_object(source: Any) -> bool:
    """Returns whether it brings its faces."""
    return not isinstance(source, np.ndarray) and any(has(source) for has, _ in _KINDS)


def faces_of(faces: Any) -> NDArray[Any] | Polygons:
    """Returns triangles as an array of shape (f, 3), and all else as polygons."""
    if isinstance(faces, Polygons):
        return faces
    try:
        array = np.asarray(faces)
    except ValueError:  # Rows of different lengths.
        return from_lists(faces)
    except Exception as error:  # Of the object.
        raise unreadable("faces", error) from error
    if array.dtype == object and array.ndim == 1 and array.size > 0:
        return from_lists(faces)
    if array.ndim == 2 and array.shape[1] > 3:
        return from_rows(array)
    return array


def _has(*names: str) -> Any:
    return lambda source: all(hasattr(source, name) for name in names)


def _is_scene(source: Any) -> bool:
    return _has("geometry", "graph")(source) and hasattr(source.graph, "nodes_geometry")


def _is_meshio(source: Any) -> bool:
    if not _has("points", "cells")(source) or not isinstance(source.cells, (list, tuple)):
        return False
    return all(hasattr(cells, "type") and hasattr(cells, "data") for cells in source.cells)


def _numbers(tensor: Any) -> NDArray[Any]:
    """Returns a tensor as an array, wherever it is."""
    tensor = tensor.cpu() if hasattr(tensor, "cpu") else tensor
    return np.asarray(tensor.numpy())


def _from_tensors(source: Any) -> tuple[Any, Any]:
    return _numbers(source.vertex.positions), _numbers(source.triangle.indices)


def _from_scene(scene: Any) -> tuple[Any, Any]:
    """Returns all meshes of a scene of trimesh, placed by its graph. Mirrored ones are turned over."""
    vertices: list[NDArray[Any]] = []
    faces: list[Polygons] = []
    count = 0
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        mesh = scene.geometry[name]
        if not hasattr(mesh, "faces") or len(mesh.faces) == 0:
            continue  # Points or paths.
        transform = np.asarray(transform, float)
        corners = np.asarray(mesh.faces).astype(np.int64) + count
        if np.linalg.det(transform[:3, :3]) < 0:
            corners = corners[:, ::-1]
        vertices.append(np.asarray(mesh.vertices) @ transform[:3, :3].T + transform[:3, 3])
        faces.append(from_rows(corners))
        count += len(mesh.vertices)
    if not faces:
        raise e.invalid("the scene has no meshes with faces")
    return np.concatenate(vertices), _plain(joined(faces))


def _plain(polygons: Polygons) -> Any:
    """Returns triangles as an array, where all faces are."""
    count = len(polygons.ends)
    if len(polygons.corners) == 3 * count and (np.diff(polygons.ends) == 3).all():
        return polygons.corners.reshape(count, 3)
    return polygons


def _from_polydata(source: Any) -> tuple[Any, Any]:
    faces = np.asarray(source.faces)
    if faces.ndim > 1:  # Rows, as trimesh has them.
        return np.asarray(source.points), faces
    parts = [from_padded(faces)]
    if hasattr(source, "strips"):
        parts.append(from_strips(source.strips))
    return np.asarray(source.points), _plain(joined(parts))


def _from_grid(source: Any) -> tuple[Any, Any]:
    """Returns the cells that are faces, or else the outer surface of those in space."""
    if hasattr(source, "celltypes") and set(np.unique(source.celltypes)) <= _VTK_FACES:
        return np.asarray(source.points), _plain(from_padded(source.cells))
    try:
        surface = source.extract_surface(algorithm="dataset_surface")
    except TypeError:  # Of an older PyVista, which has no other.
        surface = source.extract_surface()
    return _from_polydata(surface)


def _from_blocks(source: Any) -> tuple[Any, Any]:
    return _from_grid(source.combine())


def _from_meshio(source: Any) -> tuple[Any, Any]:
    parts = []
    for cells in source.cells:
        kind = str(cells.type)
        if kind in _FACE_CELLS:
            parts.append(from_rows(np.asarray(cells.data)[:, : _FACE_CELLS[kind]]))
        elif kind == "polygon" or kind.startswith("polygon"):
            parts.append(from_lists(list(cells.data)))
    if not parts:
        kinds = ", ".join(sorted({str(cells.type) for cells in source.cells})) or "none"
        raise e.invalid(f"the mesh has no faces; its cells are: {kinds}")
    return np.asarray(source.points), _plain(joined(parts))


def _from_vedo(source: Any) -> tuple[Any, Any]:
    return np.asarray(source.vertices), source.cells


def _from_faces(source: Any) -> tuple[Any, Any]:
    return np.asarray(source.vertices), source.faces


def _from_triangles(source: Any) -> tuple[Any, Any]:
    return np.asarray(source.vertices), np.asarray(source.triangles)


# In this order: some have the attributes of several.
_KINDS = (
    (_is_scene, _from_scene),
    (_has("vertex", "triangle"), _from_tensors),
    (_is_meshio, _from_meshio),
    (_has("vertices", "faces"), _from_faces),
    (_has("vertices", "triangles"), _from_triangles),
    (_has("vertices", "cells"), _from_vedo),
    (_has("points", "faces"), _from_polydata),
    (_has("points", "extract_surface"), _from_grid),
    (_has("n_blocks", "combine"), _from_blocks),
)
