"""What is odd about a mesh or samples on it, as warnings."""

from __future__ import annotations

import ctypes
import os
import sys
import warnings
from typing import TYPE_CHECKING, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _library as c
from . import _structs as s
from ._errors import GeodiskWarning, MeshWarning
from ._wording import in_python

if TYPE_CHECKING:
    from ._samples import Samples

_PACKAGE = os.path.dirname(os.path.abspath(__file__))


def oddities_of(mesh: c.Handle, source: c.Handle | None) -> tuple[MeshWarning, ...]:
    """Returns what the program prints about a mesh, which was made of `source` or of arrays."""
    found = c.Handle(
        "warnings", "geodisk_warnings_list", mesh.value, None if source is None else source.value
    )
    return tuple(MeshWarning(*one) for one in _listed(found))


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
    params = s.SampledSet(
        mesh=None if mesh is None else mesh.value,
        faces=None if faces is None else faces.ctypes.data,
        count=len(samples),
        min_distance=samples.min_distance,
        cut=samples.report.get("cut", 0),
        wanted_count=0.0 if stop_count else float(count or 0),
        stop_count=stop_count,
        darts=darts,
        face_mask=None if mask is None else mask.ctypes.data,
        existing=existing,
        avoids=int(avoids),
        lacks_features=lacks_features,
    )
    found = c.Handle("warnings", "geodisk_warnings_of_set", ctypes.byref(params))
    return tuple(GeodiskWarning(*one) for one in _listed(found))


def left_out_drivers() -> tuple[GeodiskWarning, ...]:
    """Returns what the program prints about drivers that do not load, where it uses a CPU."""
    found = c.Handle("warnings", "geodisk_warnings_of_drivers")
    return tuple(GeodiskWarning(*one) for one in _listed(found))


def _listed(found: c.Handle) -> Iterator[tuple[str, str, int]]:
    """Yields message, kind and count of each."""
    for index in range(c.warnings_count(found.value)):
        one = s.Oddity()
        c.call("geodisk_warnings_get", found.value, index, ctypes.byref(one))
        yield in_python(one.message.decode("utf-8", "replace")), one.kind.decode(), one.count


def warn_of_whole_mask(mask: NDArray[np.uint8] | None) -> None:
    """Warns of a mask that takes every triangle."""
    if mask is not None and mask.size and mask.all():
        warn([GeodiskWarning("face_mask leaves out no triangle", "mask_of_all", 1)])


def warn(found: Sequence[GeodiskWarning]) -> None:
    """Shows warnings at the line that called this package."""
    for one in found:
        warnings.warn(one, stacklevel=_level())


def _level() -> int:
    """Returns the stacklevel that warn() needs for the caller of the package."""
    level, frame = 1, sys._getframe(1)
    while frame.f_code.co_filename.startswith(_PACKAGE + os.sep) and frame.f_back is not None:
        level, frame = level + 1, frame.f_back
    return level
