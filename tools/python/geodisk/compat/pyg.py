"""Distances as PyG computes them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import _errors as e
from .._arrays import array_of, indices
from .._geodesics import geodesic_distances
from .._mesh import Mesh
from .._objects import rows_of_columns


def geodesic_distance(
    pos: Any,
    face: Any,
    src: Any = None,
    dst: Any = None,
    norm: bool = True,
    max_distance: float | None = None,
    num_workers: int = 0,
) -> Any:
    """Returns distances as ``torch_geometric.utils.geodesic_distance(pos, face)`` does.

    Parameters
    ----------
    pos : torch.Tensor of float, shape (v, 3)
    face : torch.Tensor of int, shape (3, f)
    src : torch.Tensor of int, shape (n,), optional
        Vertices to measure from, by default all.
    dst : torch.Tensor of int, shape (n,), optional
        Vertices to measure to, one for each of `src`; by default all for each.
    norm : bool
        Divide distances by the square root of the area.
    max_distance : float, optional
        Farther vertices get infinity, where PyG has 0 if it is given without `src` and `dst`. It
        is compared with normalized distances if `norm` is set.
    num_workers : int
        Ignored: all cores are used.

    Returns
    -------
    torch.Tensor, shape (n, v), or (n,) with `dst`
        On the CPU, of the type of `pos`.
    """
    import torch

    if dst is not None and np.shape(dst) != (np.shape(pos)[:1] if src is None else np.shape(src)):
        raise e.invalid("dst has not one vertex for each of src")
    mesh = Mesh(array_of(pos, "pos"), rows_of_columns(face), keep_seams=True)
    scale = mesh.area**0.5 if norm else 1.0
    sources = indices(np.arange(len(mesh.vertices)) if src is None else src, "src")
    within = None if max_distance is None else max_distance * scale
    found = np.full((len(sources), len(mesh.vertices)), np.inf)
    own = np.arange(len(sources))
    found[own, _checked(sources, mesh, "src")] = 0  # Also for one that no face uses.
    is_used = np.isin(sources, mesh.triangles)
    if is_used.any():
        each, row = np.unique(sources[is_used], return_inverse=True)
        found[is_used] = geodesic_distances(mesh, each, each=True, within=within)[row] / scale
    if dst is not None:
        found = found[own, _checked(indices(dst, "dst"), mesh, "dst")]
    return torch.from_numpy(found).to(pos.dtype)


def _checked(vertices: NDArray[Any], mesh: Mesh, name: str) -> NDArray[Any]:
    """Returns vertices of a mesh, after a check."""
    if vertices.size and int(vertices.max()) >= len(mesh.vertices):
        raise e.invalid(f"{name} has the vertex {vertices.max()}, the mesh has {len(mesh.vertices)}")
    return vertices
