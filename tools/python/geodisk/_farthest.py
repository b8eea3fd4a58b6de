"""Samples in farthest-point order."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._devices import DeviceLike, name_of
from ._existing import ExistingLike, points_of
from ._inputs import mesh_under
from ._protocols import Faces, MeshLike
from ._running import ProgressCallback
from ._samples import Samples
from ._searching import searched
from ._values import integer


@dataclass(frozen=True, eq=False)
class FarthestOrder:
    """Samples in farthest-point order: ``samples[order.indices]``.

    Attributes
    ----------
    indices : ndarray of uint32, shape (k,)
        Index of each sample, in this order.
    distances : ndarray of float32, shape (k,)
        Geodesic distance of each one to the nearest before it, never increasing. Infinite for the
        first one on each part of the mesh that has no existing point.
    cover : float
        Largest distance of a sample left out to the nearest one chosen; 0 if none is left out.
    error : float
        Distances are at most so far from exact ones on the mesh.
    searches : int
        Number of searches on the device, each of many disks.
    """

    indices: NDArray[np.uint32]
    distances: NDArray[np.float32]
    cover: float
    error: float
    searches: int

    def __len__(self) -> int:
        return len(self.indices)

    def __repr__(self) -> str:
        return f"<geodisk.FarthestOrder of {len(self)} samples>"


def farthest_order(
    samples: Samples,
    vertices: ArrayLike | MeshLike | None = None,
    faces: Faces | None = None,
    *,
    count: int | None = None,
    start: int = 0,
    existing: ExistingLike | None = None,
    edge_lengths: ArrayLike | None = None,
    weld: bool | float = False,
    keep_seams: bool = False,
    device: DeviceLike | None = None,
    progress: bool | ProgressCallback = False,
) -> FarthestOrder:
    """Returns samples in farthest-point order, along the surface.

    The first one is the sample `start`. Each further one has the largest geodesic distance to all
    before it, and to the existing points; of equally far ones it is the one of lower index. So the
    first ones of this order cover the surface evenly, however many they are.

    Parameters
    ----------
    samples : Samples
        Samples on a mesh, or points of other programs as for :func:`verify`.
    vertices, faces, edge_lengths, weld, keep_seams
        Mesh of the samples, as for :func:`sample`. Needed for samples that were read from a file.
    count : int, optional
        Stop after so many samples.
    start : int
        Index of the first sample.
    existing : Samples, array of coordinates, or a pair of face_index and barycentric, optional
        Points that are there before: the order begins with the sample farthest from all of them.
        Not with `start`.
    device, progress
        As for :func:`sample`. A callback is called on another thread.

    Returns
    -------
    FarthestOrder

    Raises
    ------
    InvalidArgument, TypeError
        For samples that are not on their mesh, a `count` above their number, and arrays of a wrong
        type or shape.
    Others as :func:`sample`.

    Examples
    --------
    >>> import geodisk
    >>> square = geodisk.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    >>> samples = geodisk.sample(square, min_distance=0.1)
    >>> order = geodisk.farthest_order(samples, count=4)
    >>> few = samples[order.indices]
    >>> len(few), bool(geodisk.verify(few, min_distance=0.7 * float(order.distances[3])))
    (4, True)
    """
    mesh = mesh_under(samples, vertices, faces, edge_lengths, weld, keep_seams)
    if mesh is None:
        raise e.invalid("samples in a box lie on no mesh")
    handle = mesh._handle
    points = points_of(handle, samples, "samples", True)
    if count is not None and not 1 <= integer(count, "count", 2**32 - 1) <= len(points):
        raise e.invalid(f"count is {count}, not from 1 to {len(points)}, the number of samples")
    if integer(start, "start", 2**32 - 1) >= len(points):
        raise e.invalid(f"start is {start}, not from 0 to {len(points) - 1}")
    size, k = len(points) if count is None else int(count), 0
    if existing is not None:
        if start != 0:
            raise e.invalid("start and existing exclude each other: existing points come first")
        before = points_of(handle, existing, "existing")
        k = len(before)
        points, size = np.concatenate([before, points]), k + size
    indices, distances = np.empty(size, np.uint32), np.empty(size, np.float32)
    info = s.FarthestInfo()
    params = s.FarthestParams(
        samples=points,
        sample_count=len(points),
        count=size,
        start=start,
        existing=k,
    )

    def find(sampler: ctypes.c_void_p, hear: Any) -> None:
        results = (indices, distances, info)
        c.call("geodisk_farthest_order", sampler, handle, params, hear, None, *results)

    searched(name_of(device), progress, find)
    return FarthestOrder(
        indices[k:] - np.uint32(k), distances[k:], info.cover, info.error, info.searches
    )
