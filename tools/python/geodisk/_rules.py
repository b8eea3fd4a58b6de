"""Which parameters exclude each other: the table of the library."""

from __future__ import annotations

import functools
from ctypes import byref
from typing import Mapping

from . import _errors as e
from . import _library as c
from . import _structs as s


@functools.lru_cache(maxsize=None)
def rules() -> tuple[tuple[str, str, str], ...]:
    """Pairs of fields that exclude each other, and the reason."""
    found: list[tuple[str, str, str]] = []
    while True:
        rule = s.Rule()
        try:
            c.call("geodisk_request_rule", len(found), byref(rule))
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
