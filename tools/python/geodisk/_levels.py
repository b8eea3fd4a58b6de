"""Samples in progressive order, level by level."""

from __future__ import annotations

from ctypes import byref, c_double, c_uint32, c_uint64
from dataclasses import dataclass
from typing import Any, Callable

import numpy as np
from numpy.typing import NDArray

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._existing import POINT
from ._mesh import Mesh
from ._results import copied, report_of
from ._running import Made, Runs
from ._values import integer, number

#: Parts of a report that add up over the levels.
_SUMMED = (
    "candidates",
    "iterations",
    "dispatches",
    "disks",
    "windows",
    "compile_seconds",
    "upload_seconds",
    "sample_seconds",
    "readback_seconds",
)


@dataclass(frozen=True)
class Levels:
    """Levels that were asked for."""

    count: int  #: 0 for a number that follows from the samples expected.
    factor: float


def levels_of(
    order: str, levels: int | None, factor: float | None, metric: str, throws: int
) -> Levels | None:
    """Returns the levels of a progressive order, None for other orders."""
    if order == "farthest" and metric != "geodesic":
        raise e.invalid(f"order='farthest' goes by distances along the surface, not {metric}")
    if order != "progressive":
        if levels is not None or factor is not None:
            name = "levels" if levels is not None else "level_factor"
            raise e.invalid(f"{name} is for order='progressive'")
        return None
    if metric != "geodesic":
        raise e.invalid(f"order='progressive' goes by distances along the surface, not {metric}")
    if throws:
        raise e.invalid("order='progressive' takes no throws; darts fill no level")
    count = 0 if levels is None else integer(levels, "levels", 2**32)
    if levels is not None and not 1 <= count <= 32:
        raise e.invalid(f"levels is {count}, not from 1 to 32")
    return Levels(count, 2.0 if factor is None else number(factor, "level_factor"))


def run_levels(
    runs: Runs,
    mesh: Mesh,
    params: s.SurfaceParams,
    levels: Levels,
    domain: Callable[[], c.Handle],
) -> Made:
    """Samples all levels, where `params` are those of the last one and `domain` makes its domain."""
    last, seed = params.min_distance, params.seed
    given, given_count = params.given, params.given_count
    count, distance, own_seed = c_uint32(levels.count), c_double(), c_uint64()
    if count.value == 0:
        c.call(
            "geodisk_level_count", mesh._handle.value, byref(params), levels.factor, byref(count)
        )
    distances, ends, reports = [], [], []
    try:
        for level in range(count.value):
            params.min_distance, params.seed = last, seed
            c.call(
                "geodisk_level_params",
                byref(params),
                levels.factor,
                count,
                level,
                byref(distance),
                byref(own_seed),
            )
            params.min_distance, params.seed = distance.value, own_seed.value
            samples = runs.run(domain())
            before = _points_of(samples)
            params.given, params.given_count = before.ctypes.data, len(before)
            distances.append(distance.value)
            ends.append(len(before))
            reports.append(report_of(samples))
    finally:
        params.min_distance, params.seed = last, seed
        params.given, params.given_count = given, given_count
    report = {**reports[-1], "given": given_count}
    report.update({name: sum(one[name] for one in reports) for name in _SUMMED})
    return Made(samples, report, tuple(distances), tuple(ends))


def _points_of(samples: c.Handle) -> NDArray[Any]:
    """Returns samples as the library takes given ones."""
    faces = copied(samples.value, s.FACE, np.uint32)
    weights = copied(samples.value, s.BARYCENTRIC, np.float32)
    assert faces is not None and weights is not None
    points = np.empty(len(faces), POINT)
    points["face"], points["weights"] = faces[:, 0], weights
    return points
