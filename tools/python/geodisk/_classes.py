"""Classes of samples, and how far they must be apart."""

from __future__ import annotations

import math
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from ._arrays import real
from ._samples import Samples

#: Number of classes, or a table of their distances.
ClassesLike = Union[int, ArrayLike]

_MAX = 8
_MIN_FACTOR = 0.01


class Classes:
    """The classes of a run: factors of the minimum distance, and distances where a table has them."""

    def __init__(self, classes: ClassesLike) -> None:
        table = real(classes, "classes").astype(np.float64) + 0.0  # -0 is 0.
        self.distances: NDArray[np.float64] | None = None
        if table.ndim == 0:
            if not 1 <= table <= _MAX or table != int(table):
                raise e.invalid(f"classes is {classes!r}, not a number from 1 to {_MAX}, or a table")
            count = int(table)
            factors = np.full((count, count), 1 / math.sqrt(count))
            np.fill_diagonal(factors, 1)
        else:
            _check(table)
            self.distances = table
            factors = table / table.max()
        self.count = len(factors)
        self.exact_factors = factors
        #: As the library takes them.
        self.factors = np.where(factors == 0, 0, np.maximum(factors, _MIN_FACTOR)).astype(np.float32)

    @property
    def largest(self) -> float | None:
        """The largest distance of the table; None without one."""
        return None if self.distances is None else float(self.distances.max())

    @property
    def density(self) -> float:
        """How many times as many samples fit as with one distance for all."""
        return float((1 / np.diag(self.factors) ** 2).sum())

    def counts_of(self, counts: Any) -> NDArray[np.uint32]:
        """Returns the number of samples of each class to keep, as the library takes it."""
        given = real(counts, "class_counts")
        if given.shape != (self.count,):
            raise e.invalid(f"class_counts has the shape {given.shape}, not ({self.count},)")
        if not ((given >= 1) & (given < 2**32) & (given == np.floor(given))).all():
            raise e.invalid("class_counts has other numbers than whole ones from 1 to 4294967295")
        return given.astype(np.uint32)

    def existing_of(self, existing: Any, count: int) -> NDArray[np.uint8]:
        """Returns the classes of `count` samples to keep: 0 unless they have some."""
        if not has_classes(existing):
            return np.zeros(count, np.uint8)
        classes: NDArray[np.uint32] = existing.columns["class"]
        if (classes >= self.count).any():
            first = int(np.argmax(classes >= self.count))
            raise e.invalid(
                f"existing: sample {first} has class {classes[first]}, but there are {self.count}, "
                "numbered from 0"
            )
        return classes.astype(np.uint8)


def has_classes(existing: Any) -> bool:
    """Returns whether samples to keep have classes."""
    return isinstance(existing, Samples) and "class" in existing.columns


def _check(table: NDArray[np.float64]) -> None:
    if table.ndim != 2 or table.shape[0] != table.shape[1] or not 1 <= len(table) <= _MAX:
        raise e.invalid(f"the table of classes has the shape {table.shape}, not (k, k) up to (8, 8)")
    if not (np.isfinite(table).all() and (table >= 0).all()):
        raise e.invalid("the table of classes has distances that are negative or not finite")
    if not (table.diagonal() > 0).all():
        raise e.invalid("the table of classes has a class that keeps no distance from itself")
    if not (table == table.T).all():
        raise e.invalid("the table of classes is not symmetric")
    if table[table > 0].min() < _MIN_FACTOR * table.max():
        raise e.invalid("the distances of classes differ by more than a factor of 100")
