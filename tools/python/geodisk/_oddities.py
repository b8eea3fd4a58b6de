"""What is odd about a mesh or samples on it, as warnings."""

from __future__ import annotations

import json
import os
import sys
import warnings
from typing import TYPE_CHECKING, Any, Sequence, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import _library as c
from ._errors import GeodiskWarning, MeshWarning
from ._wording import in_python

if TYPE_CHECKING:
    from ._samples import Samples

W = TypeVar("W", bound=GeodiskWarning)

_PACKAGE = os.path.dirname(os.path.abspath(__file__))


def oddities_of(mesh: c.Handle, source: c.Handle | None) -> tuple[MeshWarning, ...]:
    """Returns what the program prints about a mesh, which was made of `source` or of arrays."""
    return _listed(MeshWarning, "warnings_of_mesh", {"mesh": mesh, "source": source})


def oddities_of_set(
    samples: Samples,
    mesh: c.Handle | None,
    count: float | None,
    stop_count: int = 0,
    darts: int = 0,
    mask: NDArray[np.uint8] | None = None,
    existing: int = 0,
    avoids: bool = False,
    lacks_features: float = 0,
) -> tuple[GeodiskWarning, ...]:
    """Returns what the program prints about samples on a mesh, or in a box."""
    faces = None if samples.face_index is None else np.ascontiguousarray(samples.face_index)
    return _listed(
        GeodiskWarning,
        "warnings_of_set",
        {"mesh": mesh, "faces": faces, "face_mask": mask},
        count=len(samples),
        min_distance=samples.min_distance,
        cut=samples.report.get("cut", 0),
        wanted_count=0.0 if stop_count else float(count or 0),
        stop_count=stop_count,
        has_darts=darts > 0,
        existing=existing,
        avoids=avoids,
        lacks_features=lacks_features,
    )


def left_out_drivers() -> tuple[GeodiskWarning, ...]:
    """Returns what the program prints about drivers that do not load, where it uses a CPU."""
    return _listed(GeodiskWarning, "warnings_of_drivers")


def _listed(kind: type[W], *arguments: Any, **options: Any) -> tuple[W, ...]:
    """Returns the warnings that a command lists."""
    (told,) = c.run(*arguments, **options)
    return tuple(
        kind(in_python(one["message"]), one["kind"], one["count"]) for one in json.loads(told)
    )


def warn(found: Sequence[GeodiskWarning], prefix: str = "") -> None:
    """Shows warnings, after a prefix, at the line that called this package."""
    for one in found:
        shown = type(one)(f"{prefix}{one}", one.kind, one.count) if prefix else one
        warnings.warn(shown, stacklevel=_level())


def _level() -> int:
    """Returns the stacklevel that warn() needs for the caller of the package."""
    level, frame = 1, sys._getframe(1)
    while frame.f_code.co_filename.startswith(_PACKAGE + os.sep) and frame.f_back is not None:
        level, frame = level + 1, frame.f_back
    return level
