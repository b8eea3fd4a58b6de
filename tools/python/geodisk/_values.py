"""Checks of arguments that are no arrays, and of which of them exclude each other."""

from __future__ import annotations

import functools
import math
import operator
import os
import reprlib
import secrets
from typing import Any, Iterable, Mapping

import numpy as np

from . import _errors as e
from . import _library as c
from . import _structs as s


def flag(value: object, name: str) -> bool:
    """Returns True or False. Raises for anything else, such as "no", which would count as true."""
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} is {reprlib.repr(value)}, neither True nor False")
    return bool(value)


def integer(value: Any, name: str, most: int, least: int = 0) -> int:
    """Returns a whole number from `least` to `most`."""
    try:
        if isinstance(value, (bool, np.bool_)):
            raise TypeError
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {reprlib.repr(value)}, not an integer") from None
    if not least <= number <= most:
        raise e.invalid(f"{name} is {number}, not from {least} to {most}")
    return number


def number(value: Any, name: str) -> float:
    """Returns a number as float. Raises TypeError for text, arrays of several and the like."""
    is_plain = isinstance(value, (str, bytes, bool, np.bool_, complex))
    if is_plain or not (hasattr(value, "__float__") or hasattr(value, "__index__")):
        raise TypeError(f"{name} is {reprlib.repr(value)}, not a number")
    try:
        return float(value)
    except OverflowError:
        raise e.invalid(f"{name} is above 1e308, which is too large") from None
    except MemoryError:
        raise
    except Exception as error:  # Of any object.
        why = f": {error}" if str(error) else ""
        raise TypeError(f"{name} is {reprlib.repr(value)}, not a number{why}") from error


def listed(values: Any) -> list[Any] | None:
    """Returns what a sequence has; None for text, dicts and single values.

    What a generator raises stays as it is.
    """
    if isinstance(values, (str, bytes, dict, set)):
        return None
    try:
        several = iter(values)
    except Exception:  # Of any object.
        return None
    return list(several)


def seed_of(seed: Any) -> int:
    """Returns a seed of 64 bits, a random one for None."""
    return secrets.randbits(64) if seed is None else integer(seed, "seed", 2**64 - 1)


def numbers_of(values: Any, name: str) -> tuple[float, ...]:
    """Returns a sequence of numbers as float."""
    several = listed(values)
    if several is None:
        raise TypeError(f"{name} is {reprlib.repr(values)}, not a sequence of numbers")
    return tuple(number(value, name) for value in several)


def weld_of(weld: Any) -> bool | float:
    """Returns False, True, or the distance up to which vertices are joined."""
    if isinstance(weld, (bool, np.bool_)):
        return bool(weld)
    distance = number(weld, "weld")
    if not 0 <= distance < math.inf:
        raise e.invalid(f"weld is {distance}, neither True nor a distance of 0 or more")
    return distance


def pixels(size: Any, least: int) -> tuple[int, int]:
    """Returns a width and a height, each from `least` to 16384."""
    sides = listed(size)
    if sides is None or len(sides) != 2:
        raise e.invalid(f"size is {reprlib.repr(size)}, not (width, height)")
    return integer(sides[0], "size", 16384, least), integer(sides[1], "size", 16384, least)


def text(value: object, name: str) -> str:
    """Returns a str. Raises TypeError for anything else."""
    if not isinstance(value, str):
        raise TypeError(f"{name} is {reprlib.repr(value)}, not a text")
    if "\0" in value or any("\ud800" <= letter <= "\udfff" for letter in value):
        raise e.invalid(f"{name} is {reprlib.repr(value)}, which no name can be")
    return value


def choice(value: object, name: str, options: Iterable[str]) -> str:
    """Returns one of several words. Raises for anything else."""
    if not isinstance(value, str) or value not in tuple(options):  # Of a text, each letter.
        raise e.invalid(f"{name} is {reprlib.repr(value)}, none of {', '.join(options)}")
    return value


def path_of(path: object, name: str = "path") -> str:
    """Returns a path as str. Raises for anything else."""
    if not isinstance(path, (str, os.PathLike)):
        raise TypeError(f"{name} is {reprlib.repr(path)}, not a path")
    found = os.fsdecode(path)
    try:
        os.fsencode(found)
    except UnicodeEncodeError:
        found = "\0"
    if "\0" in found:
        raise e.invalid(f"{name} is {reprlib.repr(path)}, which no path can be")
    return found


def names(given: Any, name: str) -> tuple[str, ...]:
    """Returns one or several names."""
    if isinstance(given, str):
        return (text(given, name),)
    several = listed(given)
    if several is None or not all(isinstance(one, str) for one in several):
        raise TypeError(f"{name} is {reprlib.repr(given)}, neither a name nor a list of names")
    return tuple(text(one, name) for one in several)


def check_exact(exact: bool, count: float | None) -> None:
    """Checks that an exact count is one."""
    if not flag(exact, "exact"):
        return
    if count is None:
        raise e.invalid("exact=True needs a count")
    if not (1 <= count < 2**32 and float(count).is_integer()):
        raise e.invalid(f"count is {count}, but exact=True needs a whole number from 1 to 4294967295")


def check_pool(count: float | None, pool_ratio: float, darts: int = 0) -> None:
    """Checks that the pool for a count is not too large."""
    if not number(pool_ratio, "pool_ratio") >= 1:
        raise e.invalid(f"pool_ratio is {pool_ratio}, not from 1 to 10,000")
    candidates = float(count or 0) * float(pool_ratio)
    if darts == 0 and candidates >= 2**32:
        raise e.invalid(
            f"count is {count}, which needs a pool of {candidates:.3g} candidates; the maximum is "
            "4294967295"
        )


def distance_of(
    min_distance: float | None, radius: float | None, count: float | None, darts: int = 0
) -> float | None:
    """Returns the minimum distance, or None where a count chooses it."""
    if count is not None and not 1 <= number(count, "count") <= 1e300:
        raise e.invalid(f"count is {count}, not a number of at least 1")
    if count is not None and 0 < darts < count:
        raise e.invalid(f"{darts} darts cannot give {count} samples; raise darts")
    given = [x is not None for x in (min_distance, radius, count)]
    if sum(given) != 1:
        raise e.invalid("give one of min_distance, radius and count")
    if min_distance is not None:
        distance = number(min_distance, "min_distance")
    elif radius is not None:
        distance = 2 * number(radius, "radius")
    else:
        return None
    if not (distance > 0 and math.isfinite(distance)):
        raise e.invalid(f"the minimum distance is {distance}, not positive")
    return distance


def degrees_of(features: float) -> float:
    """Returns the angle from which on edges are features, checked."""
    degrees = math.nan if isinstance(features, bool) else number(features, "features")
    if not 1 <= degrees <= 180:
        raise e.invalid(f"features is {features!r}, not an angle from 1 to 180 degrees")
    return degrees


def levels_of(order: str, levels: int | None, factor: float | None) -> tuple[int, float] | None:
    """Returns the number of levels of a progressive order and their factor; None for other orders.

    The number is 0 if it follows from the samples expected.
    """
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
    return count, ratio


@functools.lru_cache(maxsize=None)
def rules() -> tuple[tuple[str, str, str], ...]:
    """Pairs of fields that exclude each other, and the reason."""
    found: list[tuple[str, str, str]] = []
    while True:
        rule = s.Rule()
        try:
            c.call("geodisk_request_rule", len(found), rule)
        except e.InvalidArgument:
            return tuple(found)
        found.append((rule.field.decode(), rule.other.decode(), rule.reason.decode()))


def check_fields(given: Mapping[str, str | None]) -> None:
    """Raises for two fields that exclude each other.

    `given` has the parameter that sets each field, as it was given; None for a field that is not set.
    """
    for field, other, reason in rules():
        if given.get(field) and given.get(other):
            raise e.invalid(f"{given[field]} and {given[other]} exclude each other: {reason}")
