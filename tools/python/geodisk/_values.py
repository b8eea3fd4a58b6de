"""Numbers that the functions that sample take."""

from __future__ import annotations

import math
import operator
from typing import Any

from . import _errors as e


def integer(value: Any, name: str, most: int) -> int:
    number = operator.index(value)
    if not 0 <= number <= most:
        raise e.invalid(f"{name} is {number}, not from 0 to {most}")
    return number


def distance_of(
    mindistance_of: float | None, radius: float | None, count: float | None
) -> float | None:
    """The minimum distance, or None where a count chooses it."""
    given = [x is not None for x in (mindistance_of, radius, count)]
    if sum(given) != 1:
        raise e.invalid("give one of mindistance_of, radius and count")
    if mindistance_of is not None:
        distance = float(mindistance_of)
    elif radius is not None:
        distance = 2 * float(radius)
    else:
        return None
    if not (distance > 0 and math.isfinite(distance)):
        raise e.invalid(f"the minimum distance is {distance}, not positive")
    return distance
