"""Faces of any number of corners, one after another."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _errors as e
from ._arrays import array_of, indices


@dataclass(frozen=True, eq=False)
class Polygons:
    """Polygons by the vertices of all their corners."""

    corners: NDArray[np.uint32]  #: Vertices of the first face, then of the second, and so on.
    ends: NDArray[np.uint64]  #: For each face, the end of its corners.

    def __len__(self) -> int:
        return len(self.ends)

    def check(self, vertex_count: int) -> None:
        """Raises MeshRejected for a corner that names no vertex."""
        bad = np.flatnonzero(self.corners >= vertex_count)
        if bad.size > 0:
            face = int(np.searchsorted(self.ends, bad[0], side="right"))
            raise e.MeshRejected(
                f"face {face} names vertex {self.corners[bad[0]]}, but there are {vertex_count}",
                "mesh_rejected",
                face,
            )


def polygons_of(corners: Any, sizes: Any) -> Polygons:
    """Returns faces of those sizes, whose corners follow each other."""
    flat = indices(corners, "faces", e.MeshRejected).astype(np.uint32, copy=False)
    return Polygons(flat, np.cumsum(np.asarray(sizes, np.uint64), dtype=np.uint64))


def from_rows(faces: NDArray[Any]) -> Polygons:
    """Returns faces of equal size, one to a row."""
    corners = indices(faces, "faces", e.MeshRejected)
    return polygons_of(corners.ravel(), np.full(len(faces), faces.shape[1]))


def from_lists(faces: Sequence[Any]) -> Polygons:
    """Returns faces of different sizes, a sequence each."""
    rows = [array_of(face, f"face {number}") for number, face in enumerate(faces)]
    for number, row in enumerate(rows):
        if row.ndim != 1 or (row.size > 0 and row.dtype.kind not in "iu"):
            raise TypeError(f"face {number} is not a sequence of integers")
    corners = [row for row in rows if row.size > 0]  # An empty list has no type.
    flat = np.concatenate(corners) if corners else np.empty(0, np.uint32)
    return polygons_of(flat, [len(row) for row in rows])


def from_padded(faces: Any) -> Polygons:
    """Returns faces of one array that has the size of each face before its corners."""
    flat = np.asarray(faces).ravel()
    if flat.size > 0 and flat.dtype.kind not in "iu":
        raise TypeError(f"faces have to be of integers, not of {flat.dtype}")
    if flat.size > 0 and flat[0] > 0 and (flat[:: flat[0] + 1] == flat[0]).all():
        if flat.size % (flat[0] + 1) == 0:  # All of one size.
            return from_rows(flat.reshape(-1, flat[0] + 1)[:, 1:])
    sizes, at = [], 0
    is_corner = np.ones(flat.size, bool)
    while at < flat.size:
        size = int(flat[at])
        if size < 0 or at + size >= flat.size:
            raise e.invalid(f"faces[{at}] is {size}, which is not the size of a face")
        is_corner[at] = False
        sizes.append(size)
        at += 1 + size
    return polygons_of(flat[is_corner], sizes)


def from_strips(strips: Polygons) -> Polygons:
    """Returns the triangles of strips."""
    triangles: list[tuple[int, int, int]] = []
    begin = 0
    for end in strips.ends.tolist():
        strip = strips.corners[begin:end].tolist()
        begin = end
        for i in range(len(strip) - 2):
            a, b = (i, i + 1) if i % 2 == 0 else (i + 1, i)
            triangles.append((strip[a], strip[b], strip[i + 2]))
    return from_rows(np.array(triangles, np.uint32).reshape(-1, 3))


def joined(parts: Sequence[Polygons]) -> Polygons:
    """Returns the faces of all parts, one part after the other."""
    ends, count = [], 0
    for part in parts:
        ends.append(part.ends + np.uint64(count))
        count += len(part.corners)
    return Polygons(np.concatenate([part.corners for part in parts]), np.concatenate(ends))
