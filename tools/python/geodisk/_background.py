"""Long calls of the library that Ctrl-C ends at once."""

from __future__ import annotations

import threading
from ctypes import c_int32
from typing import Callable, TypeVar

T = TypeVar("T")

_TIME_TO_STOP = 0.3  # Seconds.


def interruptible(work: Callable[[c_int32], T]) -> T:
    """Returns `work(stop)`, called on another thread so that this one hears of signals.

    Sets `stop` to 1 when a signal handler raises, such as KeyboardInterrupt. What goes on after a
    short time is left to end by itself, and its result is dropped.
    """
    stop = c_int32(0)
    if threading.current_thread() is not threading.main_thread():
        return work(stop)  # Only the main thread gets signals.
    done = threading.Event()
    result: list[T] = []
    failure: list[BaseException] = []

    def run() -> None:
        try:
            result.append(work(stop))
        except BaseException as error:
            failure.append(error)
        done.set()

    threading.Thread(target=run, daemon=True, name="geodisk").start()
    try:
        while not done.wait(0.1):  # Windows hears of signals in between.
            pass
    except BaseException:
        stop.value = 1
        done.wait(_TIME_TO_STOP)
        raise
    if failure:
        raise failure.pop()
    return result.pop()
