"""Samples that a run keeps, and points that it avoids."""

from __future__ import annotations

from typing import Any, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from ._arrays import indices, real
from ._placing import placed_on
from ._samples import Samples
from ._surface import Surface

#: Samples of the mesh, points of other programs, or triangles and weights.
ExistingLike = Union[Samples, Tuple[ArrayLike, ArrayLike]]

#: Points, as of ExistingLike, and their radius or radii.
AvoidLike = Tuple[ExistingLike, ArrayLike]

#: geodisk_surface_point.
POINT = np.dtype([("face", np.uint32), ("weights", np.float32, 3)])


def existing_of(surface: Surface, existing: ExistingLike | None) -> NDArray[Any]:
    """Returns the samples to keep as the library takes them; none for None."""
    if existing is None:
        return np.empty(0, POINT)
    return points_of(surface, existing, "existing")


def avoided_of(
    surface: Surface, avoid: AvoidLike | None
) -> tuple[NDArray[Any], NDArray[np.float64]]:
    """Returns points to avoid and their radii as the library takes them; none for None."""
    if avoid is None:
        return np.empty(0, POINT), np.empty(0)
    if not isinstance(avoid, (tuple, list)) or len(avoid) != 2:
        raise TypeError("avoid is a pair: points, as for existing, and their radius or radii")
    points = points_of(surface, avoid[0], "avoid")
    radii = real(avoid[1], "avoid").astype(np.float64)
    if radii.ndim > 0 and radii.shape != points.shape:
        raise e.invalid(f"avoid has {len(points)} points and radii of the shape {radii.shape}")
    return points, np.ascontiguousarray(np.broadcast_to(radii, points.shape))


def points_of(
    surface: Surface, given: ExistingLike, name: str, is_needed: bool = False
) -> NDArray[Any]:
    """Returns points as the library takes them."""
    if isinstance(given, Samples):
        given = placed_on(surface, given, name)
        assert given.face_index is not None and given.barycentric is not None
        faces, weights = given.face_index, given.barycentric
        _check_places(surface, given, faces, weights, name)
    else:
        if not isinstance(given, (tuple, list)) or len(given) != 2:
            raise TypeError(
                f"{name}: points are a geodisk.Samples, or a pair of face_index and barycentric"
            )
        faces = indices(given[0], "face_index").astype(np.uint32)
        weights = real(given[1], "barycentric").astype(np.float64)
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


def _check_places(
    surface: Surface,
    samples: Samples,
    faces: NDArray[Any],
    weights: NDArray[Any],
    name: str,
) -> None:
    """Checks that positions are those of faces and weights, which those of another mesh are not."""
    if samples.points is None or surface.edge_lengths is not None:
        return
    corners = surface.indices()
    if len(faces) == 0 or faces.max() >= len(corners):
        return  # The library refuses it.
    vertices = np.asarray(surface.coordinates(), np.float64)
    points = np.einsum("ij,ijk->ik", weights, vertices[corners[faces]])
    if points.shape != samples.points.shape:
        raise e.invalid(
            f"{name}: points have {samples.points.shape[1]} coordinates, the vertices of the "
            f"mesh {points.shape[1]}"
        )
    used = vertices[corners.ravel()]
    extent = float(np.linalg.norm(np.ptp(used, axis=0)))
    allowed = 2.0**-22 * min(float(np.abs(used).max()), 16 * extent)
    offsets = np.linalg.norm(points - samples.points, axis=1)
    if not (offsets <= allowed).all():
        first = int(np.argmax(~(offsets <= allowed)))
        raise e.invalid(
            f"{name}: sample {first} is {offsets[first]:.3g} from the point given by its face "
            "and weights; are these samples of another mesh?"
        )
