"""Devices, and the samplers that threads keep on them."""

from __future__ import annotations

import contextlib
import ctypes
import operator
import os
import reprlib
import threading
from dataclasses import dataclass
from typing import ContextManager, Iterator, Union

from . import _cpu
from . import _errors as e
from . import _library as c
from . import _structs as s
from ._oddities import warn
from ._values import text


@dataclass(frozen=True)
class Device:
    """A Vulkan device of this machine, for ``device=`` of other functions.

    Attributes
    ----------
    index : int
        Index in the list.
    name, driver : str
    type : str
        ``"discrete"``, ``"integrated"``, ``"virtual"``, ``"cpu"`` or ``"other"``.
    usable : bool
    reasons : tuple of str
        Reasons why it is not usable.
    memory : int
        Size of its largest device-local heap, in bytes.
    uuid : str
    """

    index: int
    name: str
    driver: str
    type: str
    usable: bool
    reasons: tuple[str, ...]
    memory: int
    uuid: str


_TYPES = {1: "integrated", 2: "discrete", 3: "virtual", 4: "cpu"}


def devices() -> list[Device]:
    """Returns all Vulkan devices of this machine, usable or not.

    Raises
    ------
    NoDevice
        Without loader, driver or device; the message names what to install.
    """
    global _uses_drivers
    _uses_drivers = True
    _cpu.provide()
    with _cpu.advice():
        found = c.list_devices()
    return [
        Device(
            index=i,
            name=info.name.decode(),
            driver=info.driver.decode(),
            type=_TYPES.get(info.type, "other"),
            usable=bool(info.is_usable),
            reasons=tuple(info.reasons.decode().splitlines()),
            memory=info.memory_bytes,
            uuid=bytes(info.uuid).hex(),
        )
        for i, info in enumerate(found)
    ]


#: What chooses a device: one of devices(), its index, its UUID or a part of its name.
DeviceLike = Union[Device, int, str]


def name_of(device: DeviceLike | None) -> str:
    """Returns the name of a device for the library; "" for the best one.

    None stands for the environment variable GEODISK_DEVICE.
    """
    if device is None:
        return os.environ.get("GEODISK_DEVICE", "")
    if isinstance(device, Device):
        return device.uuid if int(device.uuid, 16) != 0 else str(device.index)
    if isinstance(device, str):
        return text(device, "device")
    try:
        if isinstance(device, bool):
            raise TypeError
        return str(operator.index(device))
    except TypeError:
        raise TypeError(
            f"device is {reprlib.repr(device)}, none of devices(), nor an index, a UUID or a name"
        ) from None


_lock = threading.Lock()
_opened: dict[str, c.Handle] = {}  # Devices by name, for all threads.
_idle: dict[str, list[c.Handle]] = {}  # Samplers without a run, by name.
_uses_drivers = False


@contextlib.contextmanager
def opening(name: str) -> Iterator[None]:
    """Lets the library open a device, or raise NoDevice with what helps."""
    global _uses_drivers
    _uses_drivers = True
    _cpu.provide()
    try:
        with _cpu.advice():
            yield
    except e.NoDevice as error:
        if name and name == os.environ.get("GEODISK_DEVICE"):
            raise e.NoDevice(f"{error} (GEODISK_DEVICE is {name})", error.status) from None
        raise


def _open(name: str) -> c.Handle:
    """Returns the device, opened at the first call, which warns of drivers left out."""
    found: tuple[e.GeodiskWarning, ...] = ()
    with _lock:
        if name not in _opened:
            options = s.DeviceOptions(device=name.encode())
            with opening(name):
                _opened[name] = c.Handle("device", "geodisk_device_open", options)
            if not name and _is_cpu(_opened[name]):
                found = _cpu.warnings_of_drivers()
        device = _opened[name]
    warn(found)
    return device


def _is_cpu(device: c.Handle) -> bool:
    info = c.filled(s.DeviceInfo, "geodisk_device_describe", device)
    return _TYPES.get(info.type) == "cpu"


def sampler_on(name: str) -> ContextManager[ctypes.c_void_p]:
    """Lends a sampler on a device, for one run. Pipelines are compiled at the first call."""
    return _sampler_on(name, _open(name))


@contextlib.contextmanager
def _sampler_on(name: str, device: c.Handle) -> Iterator[ctypes.c_void_p]:
    idle = _idle.setdefault(name, [])
    try:
        sampler = idle.pop()
    except IndexError:
        sampler = c.Handle("sampler", "geodisk_sampler_create", device, None)
    is_lost = False
    try:
        yield sampler.value
    except e.DeviceLost:
        is_lost = True
        raise
    finally:
        if not is_lost:
            idle.append(sampler)


def forget(name: str) -> None:
    """Lets the next call open the device again."""
    with _lock:
        _opened.pop(name, None)
        _idle.pop(name, None)


def _forget_in_child() -> None:
    """Leaves the parent's devices alone after fork(), which drivers do not survive."""
    global _lock, _opened, _idle
    for handle in [*_opened.values(), *(one for idle in _idle.values() for one in idle)]:
        handle.abandon()
    _lock, _opened, _idle = threading.Lock(), {}, {}
    if _uses_drivers:
        c.ask("geodisk_skip_exit_handlers")


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget_in_child)
