"""What geodisk raises and warns of."""

from __future__ import annotations


class Error(Exception):
    """A call of geodisk failed.

    Attributes
    ----------
    status : str
        What kind of failure: ``"invalid_argument"``, ``"mesh_rejected"``, ``"no_device"`` ...
    element : int or None
        The face or vertex at fault, where one is.
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
    """The device stopped to work. The next call opens it anew."""


class Cancelled(Error):
    """A progress callback asked to stop, or a signal ended the program ``geodisk``."""


class NoProgram(Error):
    """The program ``geodisk``, which some functions run, is not there or of another version."""


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
    """What to raise for an argument that the library does not see."""
    return InvalidArgument(message, "invalid_argument")


class GeodiskWarning(UserWarning):
    """Base class of the warnings of geodisk. Itself, it is about samples.

    Attributes
    ----------
    kind : str
        ``"count_missed"``, ``"bare_parts"``, ``"single_samples"``; or what a mesh has.
    count : int
        Number of elements concerned.
    """

    def __init__(self, message: str, kind: str = "", count: int = 0) -> None:
        super().__init__(message)
        self.kind = kind
        self.count = count


class MeshWarning(GeodiskWarning):
    """Something is odd about a mesh. The samples are right, but perhaps not what you expect.

    Its ``kind`` is ``"unwelded"``, ``"components"``, ``"nonmanifold_edges"``, ``"duplicate_faces"``
    or another one.
    """


# Tracebacks show the names that users know.
for _kind in (Error, *Error.__subclasses__(), GeodiskWarning, MeshWarning):
    _kind.__module__ = "geodisk"
