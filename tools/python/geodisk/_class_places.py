"""Where samples of single classes may lie."""

from __future__ import annotations

from typing import Any, Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from ._classes import Classes
from ._existing import AvoidLike, avoided_of
from ._mesh import Mesh, mask_of
from ._values import integer

_ALL = 255  # The class of points that keep out all classes.


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
