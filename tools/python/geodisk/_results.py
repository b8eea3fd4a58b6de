"""Samples as the library hands them over."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _library as c
from . import _structs as s
from ._classes import Classes
from ._samples import Samples
from ._surface import Surface

_KINDS = {np.uint32: s.UINT32, np.float32: s.FLOAT32, np.float64: s.FLOAT64}


def samples_of(
    made: c.Handle,
    seed: int,
    surface: Surface | None = None,
    *,
    given: float | None = None,
    distance_part: float = 1,
    classes: Classes | None = None,
    **others: Any,
) -> Samples:
    """Returns what a run gave on a surface or in a box.

    `given` is the distance that was asked for, if any. Without it, the distance is `distance_part`
    of that of the run, see Radii.
    """
    report = report_of(made)
    count = c.ask("geodisk_samples_count", made)

    def table(attribute: int, dtype: Any = np.float64) -> Any:
        """Returns an attribute of all samples; None if they lack it."""
        width = c.ask("geodisk_samples_width", made, attribute)
        if width == 0:
            return None
        array: NDArray[Any] = np.empty((count, width), dtype)
        c.call("geodisk_samples_copy", made, attribute, _KINDS[dtype], array, 0, count)
        return array

    def column(attribute: int, dtype: Any = np.uint32) -> Any:
        """Returns an attribute of one number for each sample; None if they lack it."""
        found = table(attribute, dtype)
        return None if found is None else found[:, 0]

    distance = report["min_distance"] * distance_part if given is None else given
    report["min_distance"] = distance
    faces, weights = column(s.FACE), table(s.BARYCENTRIC)
    columns, attributes, polygons = {}, {}, None
    if surface is not None:
        columns = {name: x[faces] for name, x in surface.columns.items()}
        attributes = {name: x.at(faces, weights) for name, x in surface.attributes.items()}
        polygons = None if surface.polygons is None else surface.polygons[faces]
    if report["existing"] > 0:
        columns["existing"] = (np.arange(count) < report["existing"]).astype(np.uint32)
    radius = column(s.RADIUS, np.float64)
    if classes is not None:
        numbers = column(s.CLASS)
        columns["class"] = np.zeros(count, np.uint32) if numbers is None else numbers
        others["class_distances"] = classes.exact_factors * distance
        radius = None  # That of the class, exactly.
    levels, factor = column(s.LEVEL), report.pop("level_factor")
    if levels is None:
        del report["levels"]
    else:
        columns["level"] = levels
        distances = others["level_distances"] = _level_distances(distance, report["levels"], factor)
        ends = np.cumsum(np.bincount(levels, minlength=report["levels"]))
        report["levels"] = [
            {"min_distance": one, "samples": int(end)} for one, end in zip(distances, ends)
        ]
    features = column(s.FEATURE)
    if features is not None:
        columns["feature"] = features
        corners = int(np.count_nonzero(features == 2))
        report["corners_left_out"] = report["corners"] - corners
        report["corners"] = corners
    cover, row = column(s.COVER, np.float32), column(s.ROW)
    if cover is not None and row is not None:
        attributes.update(cover=cover.astype(np.float64), row=row.astype(np.int64))
    return Samples(
        points=table(s.POSITION),
        normals=table(s.NORMAL),
        face_index=faces,
        barycentric=weights,
        radius=radius,
        order=row,
        min_distance=distance,
        seed=seed,
        report=report,
        polygon_index=polygons,
        columns=columns,
        attributes=attributes,
        _surface=surface,
        **others,
    )


def _level_distances(distance: float, count: int, factor: float) -> tuple[float, ...]:
    """Returns the distances of all levels, as the library multiplies them."""
    distances, scale = [], 1.0
    for _ in range(count):
        distances.append(distance * scale)
        scale *= factor
    return tuple(reversed(distances))


def report_of(handle: c.Handle) -> dict[str, Any]:
    """Returns how a run went."""
    return dict(c.filled(s.Report, "geodisk_samples_report", handle).items())
