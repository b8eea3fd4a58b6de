"""Runs on a device: progress, interruption, and the search for a count."""

from __future__ import annotations

import ctypes
from ctypes import byref, c_double, c_int32
from typing import Any, Callable

import numpy as np

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._devices import DeviceLike, forget, name_of, sampler_on
from ._values import flag

_PATIENCE = 100  # Milliseconds, after which Python looks for signals.

#: Called about ten times per second with the part of the run that is done, 0 to 1, and the number of
#: samples so far. Returning False stops the run, and so does raising anything.
ProgressCallback = Callable[[float, int], object]


class Bar:
    """Progress by tqdm."""

    def __init__(self) -> None:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            raise ImportError("progress=True needs tqdm (pip install tqdm)") from None
        self._bar = tqdm(total=100, unit="%", desc="geodisk", leave=False)

    def __call__(self, part: float, samples: int) -> None:
        self._bar.n = round(100 * part, 1)
        self._bar.set_postfix(samples=samples)

    def close(self) -> None:
        self._bar.close()


def listener_of(progress: bool | ProgressCallback) -> ProgressCallback | None:
    """Returns what to call with progress, if anything; a Bar for True."""
    if callable(progress):
        return progress
    return Bar() if flag(progress, "progress") else None


def stops(answer: object) -> bool:
    """Returns whether the answer of a progress callback stops the run."""
    return isinstance(answer, (bool, np.bool_)) and not answer


#: What a run raises that a callback stopped.
STOPPED = "the progress callback returned False"


class Runs:
    """Runs one domain after another on a device, and reports progress. A context manager."""

    def __init__(self, device: DeviceLike | None, progress: bool | ProgressCallback) -> None:
        self._device = name_of(device)
        self._report = listener_of(progress)

    def __enter__(self) -> Runs:
        return self

    def __exit__(self, *_: Any) -> None:
        if isinstance(self._report, Bar):
            self._report.close()

    def run(self, domain: c.Handle) -> c.Handle:
        """Returns the samples of a domain."""
        return self._begun("geodisk_start", domain.value)

    def serve(self, mesh: c.Handle, request: s.Request) -> c.Handle:
        """Returns the samples that a request asks for."""
        return self._begun("geodisk_start_request", mesh.value, byref(request))

    def _begun(self, start: str, *arguments: Any) -> c.Handle:
        """Returns the samples of a run that a function of the library begins."""
        with sampler_on(self._device) as sampler:
            try:
                c.call(start, sampler, *arguments)
                return self._polled(sampler)
            except e.DeviceLost:
                forget(self._device)
                raise
            except BaseException:  # Ctrl-C, or what a callback raises.
                _end(sampler)
                raise

    def _polled(self, sampler: ctypes.c_void_p) -> c.Handle:
        """Goes on with a run until its samples are there. Python acts on signals in between."""
        samples = c.Handle("samples")
        progress = s.Progress()
        while not samples.value:
            c.call("geodisk_poll", sampler, _PATIENCE, byref(samples.value))
            if self._report and not samples.value:
                c.call("geodisk_sampler_progress", sampler, byref(progress))
                part = progress.decided / max(1, progress.candidates)
                if stops(self._report(part, progress.accepted)):
                    raise e.Cancelled(STOPPED, "cancelled")
        return samples


def _end(sampler: ctypes.c_void_p) -> None:
    """Stops the run in progress, if there is one."""
    rest = c.Handle("samples")
    c.cancel(sampler)
    try:
        while not rest.value:
            c.call("geodisk_poll", sampler, _PATIENCE, byref(rest.value))
    except e.Error:  # Cancelled; or it had ended.
        pass


class CountSearch:
    """Finds the distance that gives about so many samples, or at least as many if exact."""

    def __init__(self, count: float, first: float, exact: bool = False) -> None:
        if exact:
            made = c.Handle("count_search", "geodisk_count_search_create_exact", int(count))
        else:
            made = c.Handle("count_search", "geodisk_count_search_create", float(count))
        self._search = made
        self._count, self._most = count, 0
        self.next = first  #: The distance to try, or 0 when the search has ended.
        self.best: Any = None  #: What was noted with the nearest count.

    def note(self, found: Any, count: int) -> None:
        """Notes the samples that the distance gave."""
        distance, nearest = c_double(), c_int32()
        self._most = max(self._most, count)
        c.call(
            "geodisk_count_search_note",
            self._search.value,
            self.next,
            count,
            byref(distance),
            byref(nearest),
        )
        if nearest.value:
            self.best = found
        if distance.value == 0 and self.best is None:
            raise e.invalid(
                f"no distance tried gave more than {self._most} of {self._count} samples, down to "
                f"{self.next:.6g}; lower count, or leave more room for samples"
            )
        self.next = distance.value


def sampled(
    runs: Runs, domain_at: Callable[[float], c.Handle], first: float, count: float | None, exact: bool
) -> c.Handle:
    """Returns samples at the first distance, or at the one that a search for the count ends with."""
    if count is None:
        return runs.run(domain_at(first))
    search = CountSearch(count, first, exact)
    while search.next > 0:
        found = runs.run(domain_at(search.next))
        search.note(found, c.samples_count(found.value))
    best: c.Handle = search.best
    return best
