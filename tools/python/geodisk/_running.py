"""Runs on a device: progress and interruption."""

from __future__ import annotations

import contextlib
import ctypes
import sys
import time
from collections.abc import Sequence
from typing import Any, Callable, Iterator

import numpy as np

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._devices import DeviceLike, forget, name_of, sampler_on
from ._oddities import warn
from ._values import flag

_PATIENCE = 100  # Milliseconds, after which Python looks for signals.

#: Called about ten times per second with the part of the run that is done, 0 to 1, and the number of
#: samples so far. Returning False stops the run, and so does raising anything.
ProgressCallback = Callable[[float, int], object]


class Bar:
    """Progress by tqdm, or as a line on standard error where tqdm is not installed."""

    def __init__(self) -> None:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            self._bar, self._width = None, 0
        else:
            self._bar = tqdm(total=100, unit="%", desc="geodisk", leave=False)

    def __call__(self, part: float, samples: int) -> None:
        if self._bar is None:
            self._write(f"geodisk: {100 * part:.0f} %, {samples} samples")
        else:
            self._bar.n = round(100 * part, 1)
            self._bar.set_postfix(samples=samples)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
        elif self._width > 0:
            self._write("")
            self._write("")

    def _write(self, line: str) -> None:
        """Replaces the line."""
        sys.stderr.write("\r" + line.ljust(self._width))
        sys.stderr.flush()
        self._width = len(line)


class LongRun:
    """What to say of a run that takes long, once."""

    LONG = 20.0  #: Seconds that are worth a word, as for the program.
    TRIAL = 4.0  #: Seconds after which the part that is done tells how long the rest takes.

    def __init__(self) -> None:
        self._is_told = False

    def note(self, seconds: float, part: float) -> str | None:
        """Returns what to say after so many seconds, when so much, 0 to 1, is done."""
        if self._is_told or seconds < self.TRIAL:
            return None
        all_seconds = seconds / part if part > 0 else 0
        self._is_told = max(seconds, all_seconds) >= self.LONG
        if not self._is_told:
            return None
        about = f"about {all_seconds:.2g}" if part > 0.01 else f"more than {seconds:.0f}"
        return f"sampling takes {about} s on this device"


@contextlib.contextmanager
def listening(progress: bool | ProgressCallback) -> Iterator[ProgressCallback | None]:
    """Gives what to call with progress, if anything: a Bar for True, which is closed at the end."""
    report: ProgressCallback | None = progress if callable(progress) else None
    if report is None and flag(progress, "progress"):
        report = Bar()
    try:
        yield report
    finally:
        if isinstance(report, Bar):
            report.close()


def stops(answer: object) -> bool:
    """Returns whether the answer of a progress callback stops the run."""
    return isinstance(answer, (bool, np.bool_)) and not answer


#: What a run raises that a callback stopped.
STOPPED = "the progress callback returned False"


def serve(
    device: DeviceLike | None,
    progress: bool | ProgressCallback,
    requests: Sequence[tuple[c.Handle, s.Request]],
) -> list[c.Handle]:
    """Returns the samples that each request asks for, of a mesh."""
    given = (s.MeshRequest * len(requests))()
    for one, (mesh, request) in zip(given, requests):
        one.struct_size = ctypes.sizeof(s.MeshRequest)
        one.mesh, one.request = mesh, request
    return _run(device, progress, len(given), "geodisk_start_requests", given, len(given))


def serve_box(
    device: DeviceLike | None, progress: bool | ProgressCallback, request: s.BoxRequest
) -> c.Handle:
    """Returns the samples that a request asks for in a box."""
    return _run(device, progress, 1, "geodisk_start_box_request", request)[0]


def _run(
    device: DeviceLike | None,
    progress: bool | ProgressCallback,
    sets: int,
    start: str,
    *arguments: Any,
) -> list[c.Handle]:
    """Returns the sets of samples of runs that a function of the library begins."""
    name = name_of(device)
    with listening(progress) as report, sampler_on(name) as sampler:
        try:
            c.call(start, sampler, *arguments)
            return _polled(sampler, sets, report)
        except e.DeviceLost:
            forget(name)
            raise
        except BaseException:  # Ctrl-C, or what a callback raises.
            _end(sampler, sets)
            raise


def _polled(
    sampler: ctypes.c_void_p, sets: int, report: ProgressCallback | None
) -> list[c.Handle]:
    """Goes on until the samples are there. Python acts on signals in between."""
    made = (ctypes.c_void_p * sets)()
    progress, begin, before = s.Progress(), time.monotonic(), 0.0
    long_run: LongRun | None = LongRun()  # Of the first run: others may be much longer or shorter.
    while not made[0]:
        c.call("geodisk_poll", sampler, _PATIENCE, made)
        if not made[0]:
            c.call("geodisk_sampler_progress", sampler, progress)
            part = progress.decided / max(1, progress.candidates)
            long_run = long_run if part >= before else None
            before = part
            if long_run and (message := long_run.note(time.monotonic() - begin, part)):
                warn([e.GeodiskWarning(message, "long_run", 1)])
            if report and stops(report(part, progress.accepted)):
                raise e.Cancelled(STOPPED, "cancelled")
    return [c.Handle.of("samples", value) for value in made]


def _end(sampler: ctypes.c_void_p, sets: int) -> None:
    """Stops the run in progress, if there is one."""
    made = (ctypes.c_void_p * sets)()
    c.ask("geodisk_cancel", sampler)
    try:
        while not made[0]:
            c.call("geodisk_poll", sampler, _PATIENCE, made)
    except e.Error:  # Cancelled; or it had ended.
        return
    for value in made:
        c.Handle.of("samples", value)  # Is released at once.
