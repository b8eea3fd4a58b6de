"""Devices, and the samplers that threads keep on them."""

from __future__ import annotations

import ctypes
import os
import threading
from dataclasses import dataclass

from . import _library as c
from . import _structs as s


@dataclass(frozen=True)
class Device:
    """A Vulkan device of this machine.

    Attributes
    ----------
    index : int
        What ``device=str(index)`` chooses.
    name, driver : str
    type : str
        ``"discrete"``, ``"integrated"``, ``"virtual"``, ``"cpu"`` or ``"other"``.
    usable : bool
    reasons : tuple of str
        Why it is not usable.
    memory : int
        Bytes of its largest heap of its own.
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
    """All Vulkan devices of this machine, usable or not.

    Raises
    ------
    NoDevice
        Without loader, driver or device, with a hint what to install.
    """
    count = ctypes.c_size_t()
    c.call("geodisk_list_devices", None, 0, ctypes.byref(count))
    infos = (s.DeviceInfo * count.value)()
    if count.value:
        infos[0].struct_size = ctypes.sizeof(s.DeviceInfo)
        c.call("geodisk_list_devices", infos, count.value, ctypes.byref(count))
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
        for i, info in enumerate(infos)
    ]


_lock = threading.Lock()
_opened: dict[str, c.Handle] = {}  # Handles of devices by name, for all threads.
_kept = threading.local()  # Samplers by name, of this thread.


def _forget_in_child() -> None:
    """Drivers do not survive fork(): a child opens its own, and leaves alone what is its parent's."""
    global _lock, _opened, _kept
    _library_objects_of_the_parent.append((_opened, _kept))
    _lock, _opened, _kept = threading.Lock(), {}, threading.local()


_library_objects_of_the_parent: list[object] = []
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget_in_child)


def sampler_on(device: str) -> c.Handle:
    """The sampler that this thread has on a device, opened and compiled at the first call."""
    samplers: dict[str, c.Handle] = _kept.__dict__.setdefault("samplers", {})
    if device not in samplers:
        with _lock:
            if device not in _opened:
                options = s.DeviceOptions(device=device.encode())
                _opened[device] = c.Handle("device", "geodisk_device_open", ctypes.byref(options))
            opened = _opened[device]
        samplers[device] = c.Handle("sampler", "geodisk_sampler_create", opened.value, None)
    return samplers[device]


def forget(device: str) -> None:
    """Lets the next call open the device anew."""
    with _lock:
        _opened.pop(device, None)
    _kept.__dict__.setdefault("samplers", {}).pop(device, None)
