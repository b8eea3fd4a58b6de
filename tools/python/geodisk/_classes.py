"""Classes of samples: how far they must be apart, and where they may lie."""

from __future__ import annotations

import math
from typing import Any, Mapping, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from ._arrays import real
from ._existing import AvoidLike, avoided_of
from ._mesh import Mesh, mask_of
from ._samples import Samples
from ._values import integer

#: Number of classes, or a table of their distances.
ClassesLike = Union[int, ArrayLike]

_MAX = 8
_MIN_FACTOR = 0.01
_ALL = 255  # The class of points that keep out all classes.


class Classes:
    """The classes of a run: factors of the minimum distance."""

    def __init__(self, classes: ClassesLike) -> None:
        table = real(classes, "classes").astype(np.float64) + 0.0  # -0 is 0.
        self.largest: float | None = None  #: Largest distance of a table.
        if table.ndim == 0:
            if not 1 <= table <= _MAX or table != int(table):
                raise e.invalid(f"classes is {classes!r}, not a number from 1 to {_MAX}, or a table")
            count = int(table)
            factors = np.full((count, count), 1 / math.sqrt(count))
            np.fill_diagonal(factors, 1)
        else:
            _check(table)
            self.largest = float(table.max())
            factors = table / table.max()
        self.count = len(factors)
        self.exact_factors = factors
        #: As the library takes them.
        self.factors = np.where(factors == 0, 0, np.maximum(factors, _MIN_FACTOR)).astype(np.float32)

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


class ClassPlaces:
    """The shares of classes and the points that they avoid, as the library takes them."""

    def __init__(
        self,
        mesh: Mesh,
        kinds: Classes | None,
        avoid: AvoidLike | None,
        *,
        class_masks: Mapping[int, ArrayLike] | None,
        class_densities: Mapping[int, ArrayLike] | None,
        class_avoid: Mapping[int, AvoidLike] | None,
    ) -> None:
        count = 1 if kinds is None else kinds.count
        masks = _by_class(class_masks, "class_masks", count)
        densities = _by_class(class_densities, "class_densities", count)
        avoided = _by_class(class_avoid, "class_avoid", count)
        #: Shares of each class at the corners of faces, or None.
        self.shares: NDArray[np.float32] | None = None
        if masks or densities:
            self.shares = np.ones((count, len(mesh.triangles), 3), np.float32)
            for number, mask in masks.items():
                name = f"class_masks[{number}]"
                self.shares[number][mask_of(mesh._surface, mask, name) == 0] = 0
            for number, density in densities.items():
                name = f"class_densities[{number}]"
                self.shares[number] *= _parts(mesh, density, name)[mesh._surface.indices()]
            for number, share in enumerate(self.shares):
                if not share.any():
                    raise e.invalid(f"class {number} may lie nowhere")
        points, radii = avoided_of(mesh._handle, avoid)
        of_class = [np.full(len(points), _ALL, np.uint8)]
        all_points, all_radii = [points], [radii]
        for number, own in avoided.items():
            points, radii = avoided_of(mesh._handle, own, f"class_avoid[{number}]")
            all_points.append(points)
            all_radii.append(radii)
            of_class.append(np.full(len(points), number, np.uint8))
        self.points: NDArray[Any] = np.concatenate(all_points)
        self.radii: NDArray[np.float64] = np.concatenate(all_radii)
        #: Class that each point keeps out, or None if all keep out all.
        self.avoid_classes = np.concatenate(of_class) if avoided else None


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


def values_of(given: Any) -> list[Any]:
    """Returns what is given for classes; nothing for what is no dict."""
    return list(given.values()) if isinstance(given, Mapping) else []


def _by_class(given: Mapping[int, Any] | None, name: str, count: int) -> dict[int, Any]:
    """Returns what is given for each class, with the numbers checked."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise TypeError(f"{name} is a dict from the number of a class to what it gets")
    if given and count < 2:
        raise e.invalid(f"{name} is for classes, two or more")
    return {integer(number, f"the class of {name}", count - 1): one for number, one in given.items()}


def _parts(mesh: Mesh, density: ArrayLike, name: str) -> NDArray[np.float64]:
    """Returns a density at the vertices as a part of the largest one."""
    values = np.asarray(mesh._surface.vertex_values(density, name), np.float64)
    used = np.unique(mesh._surface.indices())
    wrong = used[~((values[used] >= 0) & np.isfinite(values[used]))]
    if wrong.size > 0:
        raise e.invalid(
            f"{name} is {values[wrong[0]]} at vertex {wrong[0]}, not a finite number from 0 on"
        )
    largest = float(values[used].max())
    if largest == 0:
        raise e.invalid(f"{name} is 0 everywhere")
    return np.where(np.isfinite(values), values, 0) / largest
