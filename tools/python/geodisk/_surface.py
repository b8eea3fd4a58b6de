"""The arrays of a mesh."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from ._arrays import array_of, indices, real, rows
from ._attributes import Attribute, number_named
from ._values import integer


def vertex_number(value: Any) -> int:
    if np.ndim(value) > 0:
        raise TypeError("with edge_lengths, vertices is the number of vertices, not an array")
    return integer(value, "vertices", 2**32 - 1)


@dataclass(frozen=True, eq=False)
class Surface:
    """What a mesh is made of. Arrays of the caller are kept by reference."""

    vertices: Any  #: Shape (v, d); or their number where there are lengths.
    faces: Any  #: Triangles, shape (f, 3).
    edge_lengths: Any = None  #: Shape (f, 3).
    weld: bool | float = False
    keep_seams: bool = False
    is_joined: bool = False  #: True if vertices were joined by `weld` as the mesh was read.
    polygons: NDArray[np.uint32] | None = None  #: The caller's face of each triangle, if other.
    given_faces: int | None = None  #: Number of the caller's faces, where it is known.
    attributes: dict[str, Attribute] = field(default_factory=dict)  #: Read from a file.
    columns: dict[str, NDArray[np.uint32]] = field(default_factory=dict)  #: Read from a file.
    joined: NDArray[np.uint32] | None = None  #: The lowest vertex that each was joined with.
    corners: NDArray[np.uint32] | None = None  #: Faces before vertices were joined or copied.
    is_y_up: bool = False  #: True for a file of a format in which y points up.
    copied: NDArray[np.uint32] | None = None  #: What each of the last vertices copies, at walls.
    walls: str = ""  #: What was cut, as headers tell it.

    def indices(self) -> NDArray[Any]:
        """Returns the faces as uint32 or uint16."""
        array = indices(self.faces, "faces", e.MeshRejected)
        if array.ndim != 2 or array.shape[1] != 3:
            raise e.invalid(f"faces have the shape {array.shape}, not (f, 3)")
        return array

    def own_corners(self) -> NDArray[Any]:
        """Returns the vertices of each triangle, also those that were joined or copied."""
        return self.indices() if self.corners is None else self.corners

    def repeats_vertex(self) -> NDArray[np.bool_]:
        """Returns which triangles repeat a vertex, as those that are walls do."""
        corners = self.indices()
        repeats: NDArray[np.bool_] = (corners == np.roll(corners, 1, axis=1)).any(axis=1)
        return repeats

    def coordinates(self) -> NDArray[Any]:
        """Returns the vertices as float64 or float32."""
        array = rows(real(self.vertices, "vertices"))
        if array.ndim != 2 or not 2 <= array.shape[1] <= 8:
            raise e.invalid(f"vertices have the shape {array.shape}, not (v, 2) to (v, 8)")
        return array

    def lengths(self) -> NDArray[np.float64]:
        """Returns the lengths of the edges of each face."""
        array = np.ascontiguousarray(real(self.edge_lengths, "edge_lengths"), np.float64)
        shape = np.shape(self.faces)
        if array.shape != shape:
            raise e.invalid(f"edge_lengths have the shape {array.shape}, the faces {shape}")
        return array

    def dimension(self) -> int:
        """Returns the number of coordinates of each vertex, 0 without any."""
        return 0 if self.edge_lengths is not None else int(self.coordinates().shape[1])

    def vertex_count(self) -> int:
        if self.edge_lengths is not None:
            return vertex_number(self.vertices)
        return len(self.coordinates())

    def own_vertex_count(self) -> int:
        """Returns the number of vertices without copies, which `own_corners` refers to."""
        return self.vertex_count() - (0 if self.copied is None else len(self.copied))

    def face_count(self) -> int:
        """Returns the number of faces as given, as far as it is known."""
        if self.given_faces is not None:
            return self.given_faces
        return len(self.indices()) if self.polygons is None else int(self.polygons.max()) + 1

    def by_triangle(self, values: NDArray[Any]) -> NDArray[Any]:
        """Returns the value of each triangle for those of faces as given; else what is given."""
        if values.shape[:1] != (self.face_count(),):
            return values
        return values[: len(self.indices())] if self.polygons is None else values[self.polygons]

    def mask(self, given: NDArray[Any], name: str) -> NDArray[np.uint8]:
        """Returns a mask of triangles, or of faces as given, as the library takes it."""
        if given.ndim == 1:
            given = self.by_triangle(given)
        if given.shape != (len(self.indices()),):
            raise e.invalid(f"{name} has the shape {given.shape}, not ({len(self.indices())},)")
        return np.ascontiguousarray(given).view(np.uint8)

    def vertex_values(self, values: ArrayLike, name: str) -> NDArray[Any]:
        """Returns the values as float64 or float32, one for each vertex."""
        if isinstance(values, str):
            values = number_named(self.attributes, values, name)
        array = array_of(values, name)
        if array.dtype == bool and name != "radius_factor":  # A mask.
            array = array.astype(np.float64)
        array = np.ascontiguousarray(real(array, name))
        if self.copied is not None and array.shape == (self.own_vertex_count(),):
            array = np.concatenate([array, array[self.copied]])
        if array.shape != (self.vertex_count(),):
            return self._means(array, name)
        if self.joined is not None:  # Both sides of a seam have a say.
            sums = np.bincount(self.joined, array, len(array))
            counts = np.bincount(self.joined, minlength=len(array))
            array = (sums / np.maximum(counts, 1))[self.joined]
        return array.astype(array.dtype.newbyteorder("="), copy=False)

    def _means(self, array: NDArray[Any], name: str) -> NDArray[np.float64]:
        """Returns values of faces or corners as those of vertices, as the program takes them."""
        faces, vertices = self.indices(), self.vertex_count()
        count = len(faces)
        if array.ndim == 1:
            array = self.by_triangle(array)
        if array.shape not in ((count,), (count, 3)):
            raise e.invalid(
                f"{name} has the shape {array.shape}, not ({vertices},), one for each vertex, "
                f"({count},), one for each face, or ({count}, 3), one for each corner"
            )
        if array.ndim == 1:
            at = faces.ravel()
            weights = np.repeat(self._areas(), 3)
            values = np.repeat(array.astype(np.float64), 3)
        else:  # Each value counts once at a vertex.
            pairs = np.stack([faces.ravel(), array.ravel()], axis=1).astype(np.float64)
            at, values = np.unique(pairs, axis=0).T
            at, weights = at.astype(np.int64), np.ones(len(values))
        sums = np.bincount(at, weights * values, vertices)
        totals = np.bincount(at, weights, vertices)
        means: NDArray[np.float64] = np.ones(vertices)
        np.divide(sums, totals, out=means, where=totals > 0)
        return means

    def _areas(self) -> NDArray[np.float64]:
        """Returns the areas of the triangles."""
        if self.edge_lengths is not None:
            lengths = self.lengths()
        else:
            points = self.coordinates().astype(np.float64)[self.indices()]
            lengths = np.linalg.norm(points - np.roll(points, -1, axis=1), axis=2)
        c, b, a = np.sort(lengths, axis=1).T
        product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c))
        return np.asarray(np.sqrt(np.maximum(product, 0)) / 4)
