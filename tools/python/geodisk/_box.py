"""Sampling boxes."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from . import _errors as e
from . import _structs as s
from ._arrays import real
from ._devices import DeviceLike
from ._oddities import oddities_of_set, warn
from ._results import samples_of
from ._running import ProgressCallback, serve_box
from ._samples import Samples
from ._values import check_exact, check_fields, check_pool, distance_of, seed_of
from ._wanted import numbers_in


def sample_box(
    extents: ArrayLike = (1, 1),
    *,
    periodic: bool = False,
    min_distance: float | None = None,
    radius: float | None = None,
    count: float | None = None,
    exact: bool = False,
    seed: int | None = 0,
    pool_ratio: float = 20,
    darts: int = 0,
    stop_count: int = 0,
    device: DeviceLike | None = None,
    progress: bool | ProgressCallback = False,
) -> Samples:
    """Returns random points in a box, no two closer than a minimum distance.

    The other parameters, the result and the errors are those of :func:`sample`; `face_index`,
    `barycentric` and `normals` of the result are None.

    Parameters
    ----------
    extents : sequence of float
        One to six sides; the box begins at the origin.
    periodic : bool
        Glue opposite sides together: distances wrap around.

    Examples
    --------
    >>> import geodisk
    >>> samples = geodisk.sample_box([1, 1, 1], count=500, periodic=True)
    >>> samples.points.shape[1]
    3
    """
    given = dict(locals())
    numbers = numbers_in(s.BoxParams, given)
    darts, stop_count = int(numbers["darts"]), int(numbers["stop_count"])
    distance = distance_of(min_distance, radius, count, darts)
    sides = np.array(real(extents, "extents"), np.float64, order="C")
    if sides.ndim != 1:
        raise e.invalid("extents must be one number per dimension")
    if not 1 <= len(sides) <= 6:
        raise e.invalid(f"extents has {len(sides)} dimensions, not 1 to 6")
    seed = seed_of(seed)
    check_exact(exact, count)
    check_pool(count, pool_ratio, darts)
    names = {"is_exact": "exact", "darts": "darts", "stop_count": "stop_count"}
    check_fields({field: name if given[name] else None for field, name in names.items()})
    params = s.BoxParams(
        extents=sides,
        dimension=len(sides),
        min_distance=distance or 0.0,
        seed=seed,
        **numbers,
    )
    request = s.BoxRequest(params=params, count=count or 0.0, is_exact=int(exact))
    made = serve_box(device, progress, request)
    samples = samples_of(made, seed, extents=tuple(sides.tolist()), periodic=bool(periodic))
    warn(oddities_of_set(samples, None, count, stop_count, darts))
    return samples
