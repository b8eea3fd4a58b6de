"""One sample."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Sample:
    """One sample of :class:`Samples`, which iteration and an index give.

    Attributes
    ----------
    point, normal, barycentric : ndarray of float64, or None
    face_index, polygon_index : int or None
    radius : float
    order : int
    columns : dict of int
    attributes : dict of float, int or ndarray
    """

    point: NDArray[np.float64] | None
    normal: NDArray[np.float64] | None
    face_index: int | None
    barycentric: NDArray[np.float64] | None
    polygon_index: int | None
    radius: float
    order: int
    columns: dict[str, int] = field(default_factory=dict)
    attributes: dict[str, Any] = field(default_factory=dict)
