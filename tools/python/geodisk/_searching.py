"""Searches on a mesh by the library, which may be stopped."""

from __future__ import annotations

import ctypes
from ctypes import byref
from typing import Any

import numpy as np

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._background import interruptible
from ._devices import forget, sampler_on
from ._mesh import Mesh
from ._running import Bar, ProgressCallback


def search(
    kind: str,
    function: str,
    mesh: Mesh,
    params: Any,
    device: str,
    progress: bool | ProgressCallback,
) -> c.Handle:
    """Returns what the function of the library finds on the mesh: an object of this kind."""
    bar = Bar() if progress is True else None
    report = bar if bar is not None else (progress if callable(progress) else None)
    failure: list[BaseException] = []

    def call(stop: ctypes.c_int32) -> c.Handle:
        def hear(_: Any, told: Any) -> int:
            if report is None or stop.value:
                return int(stop.value)
            try:
                state = told.contents
                answer = report(state.decided / max(1, state.candidates), state.accepted)
            except BaseException as raised:
                failure.append(raised)
                return 1
            return int(isinstance(answer, (bool, np.bool_)) and not answer)

        with sampler_on(device) as sampler:
            return c.Handle(
                kind,
                function,
                sampler,
                mesh._handle.value,
                byref(params),
                s.PROGRESS_FN(hear),
                None,
            )

    try:
        return interruptible(call)
    except e.Cancelled:
        if failure:
            raise failure[0] from None
        raise e.Cancelled("the progress callback returned False", "cancelled") from None
    except e.DeviceLost:
        forget(device)
        raise
    finally:
        if bar is not None:
            bar.close()
