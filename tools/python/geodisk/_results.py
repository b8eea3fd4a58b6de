"""Samples as the library hands them over."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _library as c
from . import _structs as s
from ._classes import Classes
from ._samples import Samples
from ._surface import Surface


_TYPES = {np.uint32: s.UINT32, np.float32: s.FLOAT32, np.float64: s.FLOAT64}


def copied(samples: ctypes.c_void_p, attribute: int, dtype: Any) -> NDArray[Any] | None:
    """Returns an attribute of all samples; None if they lack it."""
    width = c.ask("geodisk_samples_width", samples, attribute)
    if width == 0:
        return None
    count = c.ask("geodisk_samples_count", samples)
    array = np.empty((count, width), dtype)
    kind = _TYPES[dtype]
    c.call("geodisk_samples_copy", samples, attribute, kind, array.ctypes.data, 0, count)
    return array


def _polygons_of(surface: Surface | None, faces: NDArray[np.uint32]) -> NDArray[np.uint32] | None:
    """Returns the faces, as given, of triangles; None if the numbers are the same."""
    if surface is None or surface.polygons is None:
        return None
    return surface.polygons[faces]


def samples_of(
    made: c.Handle,
    seed: int,
    surface: Surface | None = None,
    *,
    given: float | None = None,
    distance_part: float = 1,
    classes: Classes | None = None,
    **box: Any,
) -> Samples:
    """Returns what a run gave on a surface or in a box.

    `given` is the distance that was asked for, if any. Without it, the distance is `distance_part`
    of that of the run, see Radii.
    """
    report = report_of(made)
    report["min_distance"] = report["min_distance"] * distance_part if given is None else given
    columns = _columns_of(made)
    columns.pop("part")
    columns["existing"] = _existing(report["samples"], report["existing"])
    if classes is not None:
        numbers = copied(made.value, s.CLASS, np.uint32)
        columns["class"] = (
            np.zeros(report["samples"], np.uint32) if numbers is None else numbers[:, 0]
        )
        box["class_distances"] = classes.exact_factors * report["min_distance"]
        columns["radius"] = None  # That of the class, exactly.
    levels = copied(made.value, s.LEVEL, np.uint32)
    if levels is not None:
        columns["level"] = levels[:, 0]
        box["level_distances"] = _level_distances(report)
        ends = np.cumsum(np.bincount(levels[:, 0], minlength=report["levels"]))
        report["levels"] = [
            {"min_distance": distance, "samples": int(end)}
            for distance, end in zip(box["level_distances"], ends)
        ]
    else:
        del report["levels"]
    del report["level_factor"]
    features = copied(made.value, s.FEATURE, np.uint32)
    if features is not None:
        columns["feature"] = features[:, 0]
        corners = int(np.count_nonzero(features == 2))
        report["corners_left_out"] = report["corners"] - corners
        report["corners"] = corners
    cover, row = copied(made.value, s.COVER, np.float32), copied(made.value, s.ROW, np.uint32)
    if row is not None:
        columns["order"] = row[:, 0]
    samples = _made(columns, surface, report, report["min_distance"], seed, **box)
    if cover is not None and row is not None:
        samples.attributes["cover"] = cover[:, 0].astype(np.float64)
        samples.attributes["row"] = row[:, 0].astype(np.int64)
    return samples


def _level_distances(report: dict[str, Any]) -> tuple[float, ...]:
    """Returns the distances of all levels, as the library multiplies them."""
    distances, scale = [], 1.0
    for _ in range(report["levels"]):
        distances.append(report["min_distance"] * scale)
        scale *= report["level_factor"]
    return tuple(reversed(distances))


def report_of(handle: c.Handle) -> dict[str, Any]:
    """Returns how a run went."""
    report = s.Report()
    c.call("geodisk_samples_report", handle.value, ctypes.byref(report))
    return {
        name: getattr(report, name)
        for name, *_ in s.Report._fields_
        if name != "struct_size"
    }


def _columns_of(handle: c.Handle) -> dict[str, NDArray[Any] | None]:
    samples = handle.value
    face, radius, part = (
        copied(samples, attribute, dtype)
        for attribute, dtype in (
            (s.FACE, np.uint32),
            (s.RADIUS, np.float64),
            (s.PART, np.uint32),
        )
    )
    return {
        "points": copied(samples, s.POSITION, np.float64),
        "normals": copied(samples, s.NORMAL, np.float64),
        "face_index": None if face is None else face[:, 0],
        "barycentric": copied(samples, s.BARYCENTRIC, np.float64),
        "radius": None if radius is None else radius[:, 0],
        "part": None if part is None else part[:, 0],
    }


def _existing(count: int, existing: int) -> NDArray[np.uint32] | None:
    """Returns 1 for the existing samples, the first; None if there are none."""
    return (np.arange(count) < existing).astype(np.uint32) if existing > 0 else None


def _made(
    columns: dict[str, Any],
    surface: Surface | None,
    report: dict[str, Any],
    distance: float,
    seed: int,
    **box: Any,
) -> Samples:
    faces = columns["face_index"]
    whole = {} if surface is None else {k: x[faces] for k, x in surface.columns.items()}
    attributes = {} if surface is None else surface.attributes
    weights = columns["barycentric"]
    for name in ("existing", "class", "level", "feature"):
        column = columns.pop(name, None)
        if column is not None:
            whole[name] = column
    return Samples(
        min_distance=distance,
        seed=seed,
        report=report,
        polygon_index=None if faces is None else _polygons_of(surface, faces),
        columns=whole,
        attributes={name: one.at(faces, weights) for name, one in attributes.items()},
        _surface=surface,
        **columns,
        **box,
    )
