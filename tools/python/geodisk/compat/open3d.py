"""Samples as Open3D makes them."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

from .. import _errors as e
from .._sampling import sample


def sample_points_poisson_disk(
    mesh: Any,
    number_of_points: int,
    init_factor: float = 5,
    pcl: None = None,
    use_triangle_normal: bool = False,
    seed: int | None = None,
) -> Any:
    """Returns points as ``mesh.sample_points_poisson_disk(number_of_points)`` of Open3D does.

    Parameters
    ----------
    mesh : open3d.geometry.TriangleMesh
    number_of_points : int
    init_factor : float
        Candidates per point, at least 20 of which are drawn.
    pcl : None
        Open3D chooses among these points, geodisk only among its own.
    use_triangle_normal : bool
        Give points the normals of triangles. By default they have interpolated normals if the
        vertices have normals.
    seed : int or None
        Equal seeds give equal points. None for a random one.

    Returns
    -------
    open3d.geometry.PointCloud
        With colours if the vertices have colours.
    """
    if pcl is not None:
        raise e.invalid("pcl is given, but geodisk draws its own candidates; leave it out")
    if not hasattr(mesh, "has_vertex_colors"):
        way = "mesh.to_legacy()" if hasattr(mesh, "to_legacy") else "it to geodisk.sample()"
        raise TypeError(
            f"mesh is a legacy open3d.geometry.TriangleMesh, not {type(mesh).__name__}; give {way}"
        )
    samples = sample(
        mesh,
        count=number_of_points,
        exact=True,
        pool_ratio=max(init_factor, 20),
        seed=seed,
        attributes=["color"] if mesh.has_vertex_colors() else (),
    )
    normals = samples.normals if use_triangle_normal else None
    if not use_triangle_normal and mesh.has_vertex_normals():
        sums = samples.interpolate(mesh.vertex_normals)
        lengths = np.linalg.norm(sums, axis=1, keepdims=True)
        normals = sums / np.where(lengths > 0, lengths, 1)
    return dataclasses.replace(samples, normals=normals).to("open3d").to_legacy()
