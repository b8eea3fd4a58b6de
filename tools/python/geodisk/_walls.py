"""Walls: faces and edges that no path crosses."""

from __future__ import annotations

import dataclasses
import re
from ctypes import byref, c_size_t
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._arrays import array_of, checksum, indices, mask_digest
from ._surface import Surface


_TOLD = re.compile("[0-9]+ (faces|edges) [0-9a-f]{8}")


def cut(surface: Surface, walls: ArrayLike) -> Surface:
    """Returns a surface cut along walls, whose seams are joined already where they are to be."""
    given = array_of(walls, "walls")
    triangles, vertices = surface.indices(), surface.vertex_count()
    params = s.Walls(
        indices=triangles,
        index_type=s.UINT16 if triangles.dtype == np.uint16 else s.UINT32,
        face_count=len(triangles),
        vertex_count=vertices,
    )
    if given.dtype == bool:
        mask = surface.mask(given, "walls")
        params.faces = mask
        told = f"{int(mask.sum())} faces {mask_digest(mask)}"
    else:
        edges = _edges_of(surface, given)
        params.edges, params.edge_count = edges, len(edges)
        told = f"{len(edges)} edges {checksum(np.unique(np.sort(edges, axis=1), axis=0))}"
    made = np.empty((len(triangles), 3), np.uint32)
    copied, count = np.empty(3 * len(triangles), np.uint32), c_size_t()
    c.call("geodisk_cut", params, made, copied, len(copied), byref(count))
    copied = copied[: count.value].copy()
    return dataclasses.replace(
        surface,
        vertices=_with_copies(surface, copied),
        faces=made,
        corners=surface.own_corners(),
        joined=_joined_with(surface, copied),
        copied=copied,
        walls=told,
    )


def are_other(told: str, own: str) -> bool:
    """Returns whether walls differ, as headers tell them. Those of the program have no checksum."""
    both_here = all(_TOLD.fullmatch(walls) for walls in (told, own))
    return told != own and (both_here or not told or not own)


def _edges_of(surface: Surface, given: NDArray[Any]) -> NDArray[np.uint32]:
    if given.size and given.dtype.kind not in "iu":
        raise e.invalid("walls are neither a mask of type bool, of triangles, nor (k, 2) integers, the "
                        "vertices of edges")
    edges = indices(given, "walls")
    if edges.ndim != 2 or edges.shape[1] != 2:
        raise e.invalid(
            f"walls have the shape {edges.shape}: neither a mask of type bool, of triangles, nor (k, 2), "
            "the vertices of edges"
        )
    if edges.size and int(edges.max()) >= surface.vertex_count():
        raise e.invalid(f"walls has the vertex {edges.max()}, the mesh has {surface.vertex_count()}")
    kept = edges.astype(np.uint32)
    return kept if surface.joined is None else np.ascontiguousarray(surface.joined[kept])


def _with_copies(surface: Surface, copied: NDArray[np.uint32]) -> Any:
    """Returns the vertices with copies of some behind them."""
    if len(copied) == 0:
        return surface.vertices
    if surface.edge_lengths is not None:
        return surface.vertex_count() + len(copied)
    coordinates = surface.coordinates()
    return np.concatenate([coordinates, coordinates[copied]])


def _joined_with(surface: Surface, copied: NDArray[np.uint32]) -> NDArray[np.uint32] | None:
    if surface.joined is None:
        return None
    first = len(surface.joined)
    own = np.arange(first, first + len(copied), dtype=np.uint32)
    joined: NDArray[np.uint32] = np.concatenate([surface.joined, own])
    return joined
