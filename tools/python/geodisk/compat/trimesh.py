"""Samples as trimesh makes them."""

from __future__ import annotations

import numbers
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._sampling import sample


def sample_surface_even(
    mesh: Any, count: int, radius: float | None = None, seed: Any = None
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Returns points as ``trimesh.sample.sample_surface_even(mesh, count)`` does.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Or any mesh that :func:`geodisk.sample` takes.
    count : int
        Number of points: exactly so many without `radius`, else at most so many.
    radius : float, optional
        Minimum distance of two points.
    seed : int or None, or what numpy.random.default_rng() takes
        Equal seeds give equal points. None for random ones.

    Returns
    -------
    samples : ndarray of float64, shape (n, 3)
    face_index : ndarray of int64, shape (n,)
    """
    if seed is not None and not isinstance(seed, numbers.Integral):
        seed = int(np.random.default_rng(seed).integers(2**63))
    if radius is None:
        samples = sample(mesh, count=count, exact=True, seed=seed)
    else:
        samples = sample(mesh, min_distance=radius, stop_count=count, seed=seed)
    assert samples.face_index is not None
    return samples.points, samples.face_index.astype(np.int64)
