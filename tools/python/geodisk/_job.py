"""What samples were made with, as far as an update needs it."""

from __future__ import annotations

import ctypes
import functools
import inspect
import struct
from dataclasses import dataclass
from typing import Any, ClassVar

from numpy.typing import ArrayLike

from . import _errors as e
from . import _library as c
from ._surface import Surface

#: Entry of headers that tells a mask from others.
MASK_DIGEST = "mask_digest"


@dataclass(frozen=True, eq=False)
class Job:
    """Parameters of :func:`sample`, by reference."""

    distance: float | None = None  #: Of the run, see Radii; None if only the samples say it.
    pool_ratio: float = 20
    density: ArrayLike | None = None
    radius_factor: ArrayLike | None = None
    face_keys: ArrayLike | None = None
    face_mask: ArrayLike | None = None
    existing: Any = None
    avoid: Any = None
    source: c.Handle | None = None  #: The file of the mesh, or what its faces were given as.


#: Parameters of sample() that are none of options(): headers tell them by other names, or not.
_PLAIN = {
    *("min_distance", "radius", "count", "seed", "levels", "level_factor", "edge_lengths", "weld"),
    *("keep_seams", "columns", "attributes", "texture", "normals", "frames", "up", "mesh_format"),
    *("allow_outside", "device", "progress"),
}


@functools.lru_cache(maxsize=None)
def options() -> dict[str, Any]:
    """Returns the parameters of sample() that samples name where they are given, with their defaults."""
    from ._sampling import sample  # Which needs this module.

    parameters = inspect.signature(sample).parameters.values()
    keywords = [one for one in parameters if one.kind is one.KEYWORD_ONLY]
    return {one.name: one.default for one in keywords if one.name not in _PLAIN}


def is_chosen(name: str, value: Any) -> bool:
    """Returns True for a value that a parameter does not have by itself."""
    usual = options()[name]
    return value is not None if usual is None else bool(value != usual)


#: Entries of headers for options of another name, or that sample() has not.
_OTHERS = {
    "mask": "face_mask",
    "only": "face_mask",
    "level_distances": "order",
    "kept_of": "order",
    "lift": "lift",
    "coordinates": "coordinates",
    "edge_lengths": "edge_lengths",
}


def option_of(key: str) -> str | None:
    """Returns the option that an entry of a header tells, or None."""
    return _OTHERS.get(key, key if key in options() else None)


@functools.lru_cache(maxsize=None)
def values() -> tuple[str, ...]:
    """Returns the entries of one value each, which samples keep and headers tell again."""
    plain = [name for name, default in options().items() if isinstance(default, (int, float, str))]
    return (*plain, "features", "kept_of", "weld", "keep_seams", "walls", MASK_DIGEST)


def joins_of(surface: Surface) -> dict[str, str]:
    """Returns how a mesh was joined and cut, as headers tell it."""
    told, weld = {}, surface.weld
    if weld is not False:
        told["weld"] = "exact" if weld is True or weld == 0 else told_text(weld)
    if surface.keep_seams:
        told["keep_seams"] = "yes"
    if surface.walls:
        told["walls"] = surface.walls
    return told


def told_text(value: bool | float | str) -> str:
    """Returns a value as headers tell it, and as the program writes it."""
    if isinstance(value, (bool, str)):
        return value if isinstance(value, str) else "yes"
    return repr(float(value)).removesuffix(".0")


@dataclass(frozen=True)
class JobFrame:
    """The distances, tolerances and rules that decided samples, as the library has them."""

    SIZE: ClassVar[int] = 128

    digits: str  #: Its bytes in hexadecimal, as headers of files have them.

    @classmethod
    def found(cls, function: str, *arguments: Any) -> JobFrame:
        """Returns the frame that a function of the library writes."""
        made = ctypes.create_string_buffer(cls.SIZE)
        c.call(function, *arguments, made)
        return cls(made.raw.hex())

    def to_bytes(self) -> bytes:
        """Returns the bytes for the library, which checks all but their number."""
        try:
            made = bytes.fromhex(self.digits)
        except ValueError:
            made = b""
        if len(made) != self.SIZE:
            raise e.invalid("the header of the samples has a wrong job_frame")
        return made

    def min_distance(self) -> float:
        """Returns the minimum distance, as the run had it."""
        return float(struct.unpack_from("<d", self.to_bytes(), 8)[0])


#: Arguments of sample() that updates follow.
FOLLOWED = (
    "pool_ratio",
    "density",
    "radius_factor",
    "face_keys",
    "face_mask",
    "existing",
    "avoid",
)
