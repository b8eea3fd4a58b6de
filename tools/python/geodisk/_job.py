"""What samples were made with, as far as an update needs it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from numpy.typing import ArrayLike

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
