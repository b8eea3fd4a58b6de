"""What samples were made with, as far as an update needs it."""

from __future__ import annotations

import ctypes
import struct
from dataclasses import dataclass
from typing import Any, ClassVar

from numpy.typing import ArrayLike

from . import _errors as e
from . import _library as c


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


#: Entries of headers that tell what samples were made with, and the argument of sample() of each.
TOLD = {
    "pool_ratio": "pool_ratio",
    "darts": "darts",
    "exact": "exact",
    "density": "density",
    "radius_factor": "radius_factor",
    "mask": "face_mask",
    "only": "face_mask",
    "metric": "metric",
    "classes": "classes",
    "features": "features",
    "at_vertices": "at_vertices",
    "level_distances": "order",
    "kept_of": "order",
    "maximal": "maximal",
    "existing": "existing",
    "avoid": "avoid",
    "lift": "lift",
    "coordinates": "coordinates",
    "edge_lengths": "edge_lengths",
}

#: Entries of one value each, which samples keep and headers tell again; also how the mesh was joined.
VALUES = (
    *("pool_ratio", "darts", "exact", "metric", "features", "at_vertices", "maximal", "kept_of"),
    *("weld", "keep_seams", "walls"),
)


def joins_of(weld: bool | float, keep_seams: bool, walls: str = "") -> dict[str, str]:
    """Returns how a mesh was joined and cut, as headers tell it."""
    told = {}
    if weld is not False:
        told["weld"] = "exact" if weld is True or weld == 0 else exact_text(weld)
    if keep_seams:
        told["keep_seams"] = "yes"
    if walls:
        told["walls"] = walls
    return told


def exact_text(number: float) -> str:
    """Returns a number as the program writes it."""
    return repr(float(number)).removesuffix(".0")


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
