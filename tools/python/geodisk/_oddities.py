"""What is odd about a mesh, as warnings."""

from __future__ import annotations

import ctypes
import os
import sys
import warnings
from typing import Sequence

from . import _library as c
from . import _structs as s
from ._errors import GeodiskWarning, MeshWarning
from ._wording import in_python

_PACKAGE = os.path.dirname(os.path.abspath(__file__))


def oddities_of(mesh: c.Handle, source: c.Handle | None) -> tuple[MeshWarning, ...]:
    """Returns what the program prints about a mesh, which was made of `source` or of arrays."""
    found = c.Handle(
        "warnings", "geodisk_warnings_list", mesh.value, None if source is None else source.value
    )
    result = []
    for index in range(c.warnings_count(found.value)):
        one = s.Oddity()
        c.call("geodisk_warnings_get", found.value, index, ctypes.byref(one))
        message = in_python(one.message.decode("utf-8", "replace"))
        result.append(MeshWarning(message, one.kind.decode(), one.count))
    return tuple(result)


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
