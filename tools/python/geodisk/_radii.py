"""Radii that vary: by a density, or by factors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._mesh import Mesh
from ._oddities import warn


@dataclass(frozen=True)
class Radii:
    """The library's radii; none by default."""

    handle: c.Handle | None = None
    #: Distances given and told, as a part of that of two samples with the largest radius.
    distance_part: float = 1.0


def one_of(density: ArrayLike | None, radius_factor: ArrayLike | None) -> str | None:
    """Which of the two is given, if any."""
    if density is not None and radius_factor is not None:
        raise e.invalid("density and radius_factor contradict each other; give just one of them")
    if density is not None:
        return "density"
    return None if radius_factor is None else "radius_factor"


def radii_of(
    mesh: Mesh, density: ArrayLike | None, radius_factor: ArrayLike | None, prefix: str = ""
) -> Radii:
    """Returns the radii that a density or factors give, if any; warnings begin with `prefix`."""
    name = one_of(density, radius_factor)
    if name is None:
        return Radii()
    given = density if name == "density" else radius_factor
    assert given is not None
    values = mesh._surface.vertex_values(given, name)
    radii = radii_on(mesh._handle, name, values)
    if name == "density" and len(values) and (values == values[0]).all():
        text = f"the density is {values[0]:g} everywhere, so it leaves out nothing"
        warn([e.GeodiskWarning(text, "constant_density", 1)], prefix)
    return radii


def radii_on(mesh: c.Handle, name: str, values: NDArray[Any]) -> Radii:
    """Returns the radii of a `density` or a `radius_factor`, whose values are of vertices."""
    handle = c.Handle(
        "radii",
        "geodisk_density_create" if name == "density" else "geodisk_radii_create",
        mesh,
        values,
        s.FLOAT32 if values.dtype == np.float32 else s.FLOAT64,
        len(values),
    )
    return Radii(handle, c.ask("geodisk_radii_min_factor", handle) if name == "density" else 1.0)
