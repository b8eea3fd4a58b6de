"""Searches, which are one call of the library and may be stopped."""

from __future__ import annotations

import ctypes
from typing import Any, Callable, TypeVar

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._background import interruptible
from ._devices import forget, sampler_on
from ._running import STOPPED, ProgressCallback, listening, stops

T = TypeVar("T")


def listened(progress: bool | ProgressCallback, call: Callable[[Any], T]) -> T:
    """Returns `call(callback)`, where the library calls the callback with its progress."""
    failure: list[BaseException] = []

    def work(stop: ctypes.c_int32) -> T:
        def hear(_: Any, told: Any) -> int:
            if report is None or stop.value or failure:
                return int(stop.value or bool(failure))
            try:
                state = told.contents
                return int(stops(report(state.decided / max(1, state.candidates), state.accepted)))
            except BaseException as raised:
                failure.append(raised)
                return 1

        return call(s.PROGRESS_FN(hear))

    try:
        with listening(progress) as report:
            found = interruptible(work)
    except e.Cancelled:
        if not failure:
            raise e.Cancelled(STOPPED, "cancelled") from None
    if failure:  # Also of the last call, which stops nothing.
        raise failure[0]
    return found


def searched(
    device: str,
    progress: bool | ProgressCallback,
    call: Callable[[ctypes.c_void_p, Any], T],
) -> T:
    """Returns `call(sampler, callback)`, as listened() calls it."""

    def with_sampler(hear: Any) -> T:
        with sampler_on(device) as sampler:
            return call(sampler, hear)

    try:
        return listened(progress, with_sampler)
    except e.DeviceLost:
        forget(device)
        raise


def search(
    kind: str,
    function: str,
    mesh: c.Handle,
    params: Any,
    device: str,
    progress: bool | ProgressCallback,
) -> c.Handle:
    """Returns what the function of the library finds on its mesh: an object of this kind."""

    def call(sampler: ctypes.c_void_p, hear: Any) -> c.Handle:
        return c.Handle(kind, function, sampler, mesh, params, hear, None)

    return searched(device, progress, call)
