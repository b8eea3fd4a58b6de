"""Samples that a run keeps, and points that it avoids."""

from __future__ import annotations

from typing import Any, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from . import _library as c
from ._arrays import indices, on_host, real
from ._inputs import places_of, run
from ._samples import Samples

#: Samples of the mesh, coordinates of points, or triangles and weights.
ExistingLike = Union[Samples, ArrayLike, Tuple[ArrayLike, ArrayLike]]

#: Points, as of ExistingLike, and their radius or radii.
AvoidLike = Tuple[ExistingLike, ArrayLike]

#: geodisk_surface_point.
POINT = np.dtype([("face", np.uint32), ("weights", np.float32, 3)])


def existing_of(mesh: c.Handle, existing: ExistingLike | None) -> NDArray[Any]:
    """Returns the samples to keep as the library takes them; none for None."""
    if existing is None:
        return np.empty(0, POINT)
    return points_of(mesh, existing, "existing")


def avoided_of(
    mesh: c.Handle, avoid: AvoidLike | None, name: str = "avoid"
) -> tuple[NDArray[Any], NDArray[np.float64]]:
    """Returns points to avoid and their radii as the library takes them; none for None."""
    if avoid is None:
        return np.empty(0, POINT), np.empty(0)
    if not isinstance(avoid, (tuple, list)) or len(avoid) != 2:
        raise TypeError(f"{name} is a pair: points, as for existing, and their radius or radii")
    points = points_of(mesh, avoid[0], name)
    radii = real(avoid[1], name).astype(np.float64)
    if radii.ndim > 0 and radii.shape != points.shape:
        raise e.invalid(f"{name} has {len(points)} points and radii of the shape {radii.shape}")
    return points, np.ascontiguousarray(np.broadcast_to(radii, points.shape))


def points_of(
    mesh: c.Handle, given: ExistingLike, name: str, is_needed: bool = False
) -> NDArray[Any]:
    """Returns points as the library takes them. Those without faces get the nearest ones."""
    if are_points(given):
        coordinates: Any = given
        places = real(coordinates, name).astype(np.float64)
        if places.shape[1] < 2:
            raise e.invalid(f"{name}: points have the shape {places.shape}, not (n, 2) to (n, 8)")
        if not np.isfinite(places).all():
            raise e.invalid(f"{name} has coordinates that are not finite")
        given = Samples(places)
    if isinstance(given, Samples):
        faces, weights = _places_of(mesh, given, name)
    else:
        if not isinstance(given, (tuple, list)) or len(given) != 2:
            raise TypeError(
                f"{name}: points are a geodisk.Samples, an array of coordinates, or a pair of "
                "face_index and barycentric"
            )
        faces = indices(given[0], f"{name}: face_index").astype(np.uint32)
        weights = real(given[1], f"{name}: barycentric").astype(np.float64)
    if faces.ndim != 1 or weights.shape != (len(faces), 3):
        raise e.invalid(
            f"{name}: face_index has the shape {faces.shape}, barycentric {weights.shape}, not "
            "(n,) and (n, 3)"
        )
    points = np.empty(len(faces), POINT)
    points["face"], points["weights"] = faces, weights
    if len(points) == 0:
        message = "there is no sample" if is_needed else f"{name} has no samples; leave it out"
        raise e.invalid(message)
    return points


def are_points(given: Any) -> bool:
    """Returns True for coordinates of points. A tuple of two is a pair of faces and weights."""
    if isinstance(given, Samples) or (isinstance(given, tuple) and len(given) == 2):
        return False
    if isinstance(given, list) and len(given) == 2 and np.ndim(given[0]) != np.ndim(given[1]):
        return False
    try:
        return np.asarray(on_host(given)).ndim == 2
    except ValueError:  # Rows of several lengths.
        return False


def _places_of(
    mesh: c.Handle, samples: Samples, name: str
) -> tuple[NDArray[np.uint32], NDArray[np.float64]]:
    if samples.face_index is None and samples.extents is not None:
        raise e.invalid(f"{name}: samples in a box lie on no mesh")
    if len(samples) == 0:
        return np.empty(0, np.uint32), np.empty((0, 3))
    if samples.points is None:
        assert samples.face_index is not None and samples.barycentric is not None
        return samples.face_index, samples.barycentric
    try:
        return places_of(*run("place", samples, mesh))
    except e.InvalidArgument as error:
        message = str(error).replace("samples: ", "", 1).replace(
            "off mesh than tolerance allows", "off the mesh than a thousandth of its diagonal"
        )
        raise e.invalid(f"{name}: {message}") from None
