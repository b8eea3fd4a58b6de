"""Checks that samples keep their distance."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from ._existing import POINT, AvoidLike, avoided_of
from ._inputs import mesh_under, option, run
from ._mesh import Mesh, mask_of
from ._oddities import warn
from ._protocols import Faces, MeshLike
from ._radii import Radii, one_of, radii_on
from ._samples import Samples
from ._surface import Surface
from ._values import flag, number
from ._walls import are_other
from ._writing import has_own_radii


@dataclass(frozen=True, eq=False)
class Verification:
    """Result of :func:`verify`. It is true if nothing is wrong.

    Attributes
    ----------
    samples : int
        Number of samples.
    min_distance : float
        Required distance; with a radius_factor, of two samples with the largest radius. NaN if
        each sample keeps its own radius.
    smallest : float
        Distance of the closest pair, relative to its radii if these vary. Infinite if all are
        farther apart than 1.25 times the required distance.
    smallest_ratio : float
        This distance divided by the required one.
    closest : tuple of two int, or None
        The closest pair.
    violations : ndarray of int64, shape (k, 2)
        Pairs that are too close by more than a billionth, closest first.
    distances : ndarray of float64, shape (k,)
        Distances of these pairs.
    complete : bool
        False if the check ended after a million violations.
    misplaced : int
        Number of samples that are not at the point given by face and weights, outside the box, or
        farther from the mesh than the tolerance.
    wrong_radii : int
        Number of samples whose radius does not match the density.
    rho : float
        Packing density; NaN in boxes, and without a minimum distance.
    existing : int
        Number of samples with a 1 in ``columns["existing"]``.
    existing_violations : ndarray of int64, shape (k, 2)
        Pairs of these that are too close, closest first. They count as no violations.
    level_violations : tuple of int
        Numbers of pairs too close for each level of progressive order, among the samples up to its
        end. Empty in dart order, and with `min_distance`.
    masked : int
        Number of samples on triangles that `face_mask` leaves out, except existing ones.
    within_avoided : ndarray of int64, shape (k,)
        Samples within the radius of a point of `avoid`, except existing ones.
    is_maximal : bool or None
        With `maximal`, whether no further sample fits anywhere; else None.
    largest_gap : float
        With `maximal`, no point is farther than this from all samples; else, and if radii vary,
        NaN. If a sample fits, the gap is at least this large.
    """

    samples: int
    min_distance: float
    smallest: float
    smallest_ratio: float
    closest: tuple[int, int] | None
    violations: NDArray[np.int64]
    distances: NDArray[np.float64]
    complete: bool
    misplaced: int
    wrong_radii: int
    rho: float
    existing: int
    existing_violations: NDArray[np.int64]
    level_violations: tuple[int, ...] = ()
    masked: int = 0
    within_avoided: NDArray[np.int64] = field(default_factory=lambda: np.empty(0, np.int64))
    is_maximal: bool | None = None
    largest_gap: float = math.nan

    @property
    def ok(self) -> bool:
        """True if no pair is too close, no sample in a wrong place and no radius wrong.

        With `maximal` also only if no further sample fits.
        """
        return (
            len(self.violations) == 0
            and self.misplaced == 0
            and self.wrong_radii == 0
            and not any(self.level_violations)
            and self.masked == 0
            and len(self.within_avoided) == 0
            and self.is_maximal is not False
        )

    def __bool__(self) -> bool:
        return self.ok

    def __repr__(self) -> str:
        found = "ok"
        if not self.ok:
            found = f"{len(self.violations)} too close, {self.misplaced} misplaced"
            if self.wrong_radii > 0:
                found += f", {self.wrong_radii} of wrong radius"
            if any(self.level_violations):
                found += f", {sum(self.level_violations)} too close in levels"
            if self.masked > 0:
                found += f", {self.masked} outside the mask"
            if len(self.within_avoided) > 0:
                found += f", {len(self.within_avoided)} near points to avoid"
            if self.is_maximal is False:
                found += ", not maximal"
        smallest = "no pair within the search"
        if math.isfinite(self.smallest):
            smallest = (
                f"smallest distance {self.smallest:.9g}, {self.smallest_ratio:.9g} of the "
                "required one"
            )
        return f"<geodisk.Verification: {self.samples} samples, {found}, {smallest}>"


def verify(
    samples: Samples,
    vertices: ArrayLike | MeshLike | None = None,
    faces: Faces | None = None,
    *,
    min_distance: float | None = None,
    density: ArrayLike | None = None,
    radius_factor: ArrayLike | None = None,
    face_mask: ArrayLike | None = None,
    avoid: AvoidLike | None = None,
    maximal: bool = False,
    edge_lengths: ArrayLike | None = None,
    weld: bool | float = False,
    keep_seams: bool = False,
    tolerance: float | None = None,
) -> Verification:
    """Computes the distances of samples again, on the CPU in double precision.

    This is a separate implementation, the one of ``geodisk verify``.

    Parameters
    ----------
    samples : Samples
        Samples on a mesh or in a box. With a mesh, also points of other programs without
        `face_index`: ``Samples(points)``. They are put on the nearest triangles.
    vertices, faces, edge_lengths, weld, keep_seams
        Mesh of the samples, as for :func:`sample`. Needed for samples that were read from a file.
    min_distance : float, optional
        Required distance, in the unit of the vertices. By default each sample keeps its radius, or
        the distances of its class.
    density, radius_factor : array_like of float or str, optional
        As for :func:`sample`. Radii are computed again from it and the minimum distance (by default
        that of the samples), and compared with those of the samples.
    face_mask, avoid
        As for :func:`sample`. All samples but existing ones must lie on these triangles, and outside
        the radii of these points.
    maximal : bool, default False
        Whether to check that no further sample fits anywhere. Takes `face_mask` and `avoid` into
        account.
    tolerance : float, optional
        Maximum distance of such points from the mesh, by default a thousandth of the bounding-box
        diagonal. Points farther away count as misplaced.

    Returns
    -------
    Verification
        Also if samples are too close; this raises no exception.

    Raises
    ------
    InvalidArgument
        For samples that are not on this mesh, or without a mesh or distance.
    MeshRejected, TypeError
        As for :func:`sample`.
    KeyboardInterrupt
        Ctrl-C ends it at once.

    Warns
    -----
    GeodiskWarning
        For samples that were made on a mesh of other walls, as far as they tell them.

    Examples
    --------
    >>> import geodisk
    >>> samples = geodisk.sample_box([1, 1], min_distance=0.1, seed=3)
    >>> found = geodisk.verify(samples)
    >>> found.ok, found.smallest >= 0.1
    (True, True)
    >>> found = geodisk.verify(samples, min_distance=0.15)
    >>> found.ok, found.violations.shape[1]
    (False, 2)
    """
    maximal = flag(maximal, "maximal")
    varying = one_of(density, radius_factor)
    mesh = mesh_under(samples, vertices, faces, edge_lengths, weld, keep_seams)
    surface = None if mesh is None else mesh._surface
    if min_distance is not None:
        min_distance = number(min_distance, "min_distance")
        if not (min_distance > 0 and math.isfinite(min_distance)):
            raise e.invalid(f"the minimum distance is {min_distance}, not positive")
    elif (varying or not has_own_radii(samples)) and not samples.min_distance > 0:
        raise e.invalid(
            f"the minimum distance of these samples is {samples.min_distance}; give min_distance"
        )
    if varying and surface is None:
        raise e.invalid(f"{varying} is of a mesh, and these samples are in a box")
    if surface is None and (face_mask is not None or avoid is not None or maximal):
        raise e.invalid("face_mask, avoid and maximal are of a mesh, and these samples are in a box")
    mask = None if surface is None or face_mask is None else mask_of(surface, face_mask)
    if mask is not None and not mask.any():
        raise e.invalid("face_mask leaves out all faces")
    if surface is not None:
        _warn_of_walls(samples, surface)
    radii = Radii()
    given = radius_factor if density is None else density
    if varying and mesh is not None and surface is not None and given is not None:
        values = surface.vertex_values(given, varying)
        corners = surface.indices()
        small = corners[values[corners] < 0.001]
        if varying == "radius_factor" and small.size > 0:
            raise e.invalid(f"the {varying} of vertex {small[0]} is {values[small[0]]}, below 0.001")
        radii = radii_on(mesh._handle, varying, values)
    points, point_radii = _avoided_on(mesh, avoid)
    (told,) = run(
        "verify",
        samples,
        None if mesh is None else mesh._handle,
        tolerance,
        {
            "radii": radii.handle,
            "face_mask": mask,
            "avoid": points,
            "avoid_radii": point_radii,
        },
        min_distance=option(min_distance, "min_distance"),
        maximal=maximal,
        distance_part=radii.distance_part,
        avoided=len(points),
    )
    report = json.loads(told)
    violations, closest = report["violations"], report["smallest"]
    existing, gaps = report.get("existing"), report.get("maximal")
    intrusions = (report.get("avoided") or {}).get("intrusions", {})
    gap = None if gaps is None else gaps["largest_gap"]
    distance, rho = report["min_distance"], report.get("rho")
    return Verification(
        samples=len(samples),
        min_distance=math.nan if distance is None else distance,
        smallest=math.inf if closest is None else closest["distance"],
        smallest_ratio=math.inf if closest is None else report["smallest_ratio"],
        closest=None if closest is None else (closest["samples"][0], closest["samples"][1]),
        violations=_pairs(violations),
        distances=np.array(violations["distances"], np.float64),
        complete=violations["complete"],
        misplaced=report["outside"] if surface is None else report["off_the_mesh"],
        wrong_radii=report.get("wrong_radii", 0),
        rho=math.nan if rho is None else rho,
        existing=0 if existing is None else existing["samples"],
        existing_violations=_pairs({} if existing is None else existing["violations"]),
        level_violations=tuple(
            level["violations"]["pairs"] for level in report.get("levels") or []
        ),
        masked=report.get("masked") or 0,
        within_avoided=np.array(intrusions.get("rows", []), np.int64),
        is_maximal=None if gaps is None else gaps["certificate"],
        largest_gap=math.nan if gap is None else gap,
    )


def _avoided_on(
    mesh: Mesh | None, avoid: AvoidLike | None
) -> tuple[NDArray[Any], NDArray[np.float64]]:
    """Returns points to avoid and their radii, which have to be right."""
    if mesh is None or avoid is None:
        return np.empty(0, POINT), np.empty(0)
    points, radii = avoided_of(mesh._handle, avoid)
    count = len(mesh.triangles)
    if (outside := points["face"] >= count).any():
        first = int(np.argmax(outside))
        raise e.invalid(
            f"avoid: point {first} is in face {points['face'][first]}, the mesh has {count}"
        )
    if (wrong := ~((radii > 0) & np.isfinite(radii))).any():
        first = int(np.argmax(wrong))
        raise e.invalid(f"avoid: point {first} has the radius {radii[first]}, not a positive one")
    return points, radii


def _warn_of_walls(samples: Samples, surface: Surface) -> None:
    """Warns of samples that were made on a mesh of other walls."""
    told, own = samples._told.get("walls", ""), surface.walls
    is_made_there = samples.seed is not None and "transfer" not in samples.report.get("options", [])
    if is_made_there and are_other(told, own):
        made = f"with walls={told}" if told else "without walls"
        here = f"walls={own}" if own else "none"
        text = f"the samples were made {made}, and this mesh has {here}; distances may differ"
        warn([e.GeodiskWarning(text, "other_surface", 1)])


def _pairs(violations: dict[str, Any]) -> NDArray[np.int64]:
    """Returns the rows of each pair."""
    rows = [violations.get("rows_a", []), violations.get("rows_b", [])]
    return np.ascontiguousarray(np.array(rows, np.int64).T)
