"""The levels of samples in progressive order, as asked for."""

from __future__ import annotations

from dataclasses import dataclass

from . import _errors as e
from ._values import integer, number

@dataclass(frozen=True)
class Levels:
    """Levels that were asked for."""

    count: int  #: 0 for a number that follows from the samples expected.
    factor: float


def levels_of(order: str, levels: int | None, factor: float | None) -> Levels | None:
    """Returns the levels of a progressive order, None for other orders."""
    if order != "progressive":
        if levels is not None or factor is not None:
            name = "levels" if levels is not None else "level_factor"
            raise e.invalid(f"{name} is for order='progressive'")
        return None
    count = 0 if levels is None else integer(levels, "levels", 2**32)
    if levels is not None and not 1 <= count <= 32:
        raise e.invalid(f"levels is {count}, not from 1 to 32")
    ratio = 2.0 if factor is None else number(factor, "level_factor")
    if not 1.1 <= ratio <= 8:
        raise e.invalid(f"level_factor is {ratio:g}, not from 1.1 to 8")
    return Levels(count, ratio)
