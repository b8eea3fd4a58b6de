"""Exceptions and warnings of geodisk."""

from __future__ import annotations


class Error(Exception):
    """A call of geodisk failed.

    Attributes
    ----------
    status : str
        Kind of failure: ``"invalid_argument"``, ``"mesh_rejected"``, ``"no_device"`` ...
    element : int or None
        The offending face or vertex, if there is one.
    """

    def __init__(
        self, message: str, status: str = "internal", element: int | None = None
    ) -> None:
        super().__init__(message)
        self.status = status
        self.element = element


class InvalidArgument(Error, ValueError):
    """A value is out of its range, or arguments contradict each other."""


class MeshRejected(Error, ValueError):
    """The mesh cannot be sampled; ``element`` names the face or vertex."""


class NoDevice(Error):
    """There is no Vulkan loader, driver or device that can run geodisk."""


class OutOfMemory(Error, MemoryError):
    """The host or the device is out of memory."""


class DeviceLost(Error):
    """The device stopped working. The next call opens it again."""


class Cancelled(Error):
    """A progress callback asked to stop."""


#: Exceptions by status.
BY_STATUS = {
    -1: InvalidArgument,
    -2: MeshRejected,
    -3: NoDevice,
    -4: NoDevice,
    -5: OutOfMemory,
    -6: OutOfMemory,
    -7: OutOfMemory,
    -8: DeviceLost,
    -9: Cancelled,
    -11: OutOfMemory,
}


def invalid(message: str) -> InvalidArgument:
    """Returns the error for an argument that is checked in Python."""
    return InvalidArgument(message, "invalid_argument")


class GeodiskWarning(UserWarning):
    """Base class of the warnings of geodisk; used directly for warnings about samples.

    Attributes
    ----------
    kind : str
        ``"count_missed"``, ``"bare_parts"``, ``"single_samples"``, ``"not_kept"``, ``"long_run"``; or
        a kind of MeshWarning.
    count : int
        Number of elements concerned.
    """

    def __init__(self, message: str, kind: str = "", count: int = 0) -> None:
        super().__init__(message)
        self.kind = kind
        self.count = count


class MeshWarning(GeodiskWarning):
    """The mesh has an oddity. The samples are correct, but may not be what you expect.

    Its ``kind`` is ``"unwelded"``, ``"components"``, ``"nonmanifold_edges"``, ``"duplicate_faces"``
    or another one.
    """


# Tracebacks show the names that users know.
for _kind in (Error, *Error.__subclasses__(), GeodiskWarning, MeshWarning):
    _kind.__module__ = "geodisk"
