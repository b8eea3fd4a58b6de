"""Samples on the corners and curves of a mesh, before those on its faces."""

from __future__ import annotations

import math

from . import _errors as e
from ._values import number


def degrees_of(features: float) -> float:
    """Returns the angle from which on edges are features, checked."""
    degrees = math.nan if isinstance(features, bool) else number(features, "features")
    if not 1 <= degrees <= 180:
        raise e.invalid(f"features is {features!r}, not an angle from 1 to 180 degrees")
    return degrees
