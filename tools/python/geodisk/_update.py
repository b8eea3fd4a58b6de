"""Samples that follow an edit of their mesh."""

from __future__ import annotations

import ctypes
import dataclasses
import math
from ctypes import byref
from typing import Any, Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._devices import DeviceLike, name_of
from ._existing import POINT, AvoidLike, ExistingLike, avoided_of, existing_of, points_of
from ._inputs import surface_of
from ._job import FOLLOWED, Job
from ._mesh import Mesh, is_mesh, keys_of, mask_of, mesh_of
from ._protocols import Faces, MeshLike
from ._radii import radii_of
from ._results import samples_of
from ._running import Made, ProgressCallback
from ._samples import Samples
from ._searching import searched
from ._surface import Surface
from ._writing import SELECTION


def update(
    samples: Samples,
    to: ArrayLike | MeshLike | None = None,
    to_faces: Faces | None = None,
    *,
    density: ArrayLike | None = None,
    radius_factor: ArrayLike | None = None,
    face_keys: ArrayLike | None = None,
    face_mask: ArrayLike | None = None,
    existing: ExistingLike | None = None,
    avoid: AvoidLike | None = None,
    before: Mapping[str, Any] | None = None,
    vertices: ArrayLike | MeshLike | None = None,
    faces: Faces | None = None,
    weld: bool | float = False,
    keep_seams: bool = False,
    device: DeviceLike | None = None,
    progress: bool | ProgressCallback = False,
) -> Samples:
    """Returns the samples of an edited mesh, and decides only what the edit can reach.

    The samples are those of a whole run over the edited mesh with the same seed and distance, in
    the frame of the mesh before: see "Updates" in the documentation.

    Parameters
    ----------
    samples : Samples
        All samples of :func:`sample` on the mesh before, in any order. Not with throws, stop_count, exact, classes, features,
        maximal, another order or another metric.
    to : array_like of float, shape (v, d), or a mesh
        The edited mesh, or positions of its vertices; the mesh before by default.
    to_faces : array_like of int, optional
        Faces of the edited mesh; those of the mesh before by default.
    density, radius_factor, face_keys, face_mask, existing, avoid
        Parameters of :func:`sample` on the edited mesh. By default those of the mesh before, to which
        samples of :func:`sample` refer. A density must keep its largest and least value. An empty
        pair as `existing` or as points of `avoid` removes those before.
    before : mapping, optional
        The same parameters on the mesh before, and `pool_ratio`, by name. Needed for samples that
        were read from a file, if they were made with any.
    vertices, faces, weld, keep_seams
        Mesh before the edit, as for :func:`sample`. Needed for samples that were read from a file.
    device, progress
        As for :func:`sample`. A callback is called on another thread.

    Returns
    -------
    Samples
        Samples on the edited mesh. Those far from the edit are as before. The report counts only what
        was decided again.

    Raises
    ------
    InvalidArgument
        For samples that are not on their mesh, of another run than above, or not all of a run, and for
        an edge that became too long.
    Others as :func:`sample`.

    Examples
    --------
    >>> import geodisk, numpy as np
    >>> corners = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    >>> tetrahedron = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]
    >>> samples = geodisk.sample(corners, tetrahedron, min_distance=0.4, seed=1)
    >>> moved = corners.copy()  # The samples refer to the array before.
    >>> moved[0] *= 1.2
    >>> edited = geodisk.update(samples, moved)
    >>> whole = geodisk.sample(moved, tetrahedron, min_distance=0.4, seed=1)
    >>> np.array_equal(edited.points, whole.points)
    True
    >>> masked = geodisk.update(edited, face_mask=[0, 1, 2])
    >>> int(masked.face_index.max())
    2
    """
    source = surface_of(samples, vertices, faces, None, weld, keep_seams)
    if source is None:
        raise e.invalid("samples in a box have no mesh")
    if samples.seed is None or not samples.min_distance > 0:
        raise e.invalid("these samples do not know their seed and minimum distance")
    job = _job_of(samples, before)
    given = {
        "density": density,
        "radius_factor": radius_factor,
        "face_keys": face_keys,
        "face_mask": face_mask,
        "existing": existing,
        "avoid": avoid,
    }
    edited = dataclasses.replace(job, **{k: x for k, x in given.items() if x is not None})
    if existing is None:
        edited = dataclasses.replace(edited, existing=_places(job.existing))
    if avoid is None and job.avoid is not None:
        edited = dataclasses.replace(edited, avoid=(_places(job.avoid[0]), job.avoid[1]))
    old = _Side(_mesh_on(source), job, samples)
    new = _Side(_target(source, to, to_faces) or old.mesh, edited, samples)
    points = points_of(source, samples, "samples", True)
    info = s.UpdateInfo()

    def find(sampler: ctypes.c_void_p, hear: Any) -> c.Handle:
        updater = c.Handle(
            "updater",
            "geodisk_updater_create_edited",
            *old.arguments(),
            *new.arguments(),
            None,
            points.ctypes.data,
            len(points),
        )
        c.call(
            "geodisk_update",
            updater.value,
            sampler,
            *new.arguments(),
            None,
            0,
            hear,
            None,
            byref(info),
        )
        return c.Handle("samples", "geodisk_updater_samples", updater.value)

    made = Made(searched(name_of(device), progress, find))
    there = samples_of(made, samples.seed, new.mesh._surface, given=samples.min_distance)
    there.report["options"] = [
        name for name in FOLLOWED if _is_chosen(name, getattr(edited, name))
    ]
    there.report["update"] = {
        name: getattr(info, name) for name in ("rounds", "faces", "uploaded", "removed", "added")
    }
    return dataclasses.replace(there, _job=edited)


class _Side:
    """A mesh and its parameters as the library takes them."""

    def __init__(self, mesh: Mesh, job: Job, samples: Samples) -> None:
        self.mesh = mesh
        radii = radii_of(mesh, job.density, job.radius_factor)
        keys = None if job.face_keys is None else keys_of(mesh, job.face_keys)
        mask = None if job.face_mask is None else mask_of(mesh._surface, job.face_mask)
        kept = _existing(mesh._surface, job.existing)
        avoided, avoid_radii = _avoided(mesh._surface, job.avoid)
        self._kept_alive = (radii, keys, mask, kept, avoided, avoid_radii)
        distance = samples.min_distance / (1.0 if radii is None else radii.distance_part)
        if job.distance is not None:
            if not math.isclose(job.distance, distance, rel_tol=1e-12):
                raise e.invalid(f"these samples were not made {samples.min_distance} apart")
            distance = job.distance  # Before it was rounded.
        self._params = s.SurfaceParams(
            min_distance=distance,
            seed=samples.seed,
            pool_ratio=float(job.pool_ratio),
            radii=None if radii is None else radii.handle.value,
            face_keys=None if keys is None else keys.ctypes.data,
            face_mask=None if mask is None else mask.ctypes.data,
            given=kept.ctypes.data,
            given_count=len(kept),
            avoid=avoided.ctypes.data,
            avoid_radii=avoid_radii.ctypes.data,
            avoid_count=len(avoided),
        )

    def arguments(self) -> tuple[Any, Any]:
        return self.mesh._handle.value, byref(self._params)


def _job_of(samples: Samples, before: Mapping[str, Any] | None) -> Job:
    """Returns what the samples were made with."""
    options = samples.report.get("options", [])
    if SELECTION in options or not samples._is_whole():
        raise e.invalid("some samples of the set were removed, added or changed; give all of it")
    if others := [name for name in options if name not in FOLLOWED]:
        raise e.invalid(
            f"samples made with {', '.join(others)} cannot be updated; sample the mesh again"
        )
    if before is not None:
        if unknown := [name for name in before if name not in FOLLOWED]:
            raise TypeError(f"before has {unknown[0]!r}, none of {', '.join(FOLLOWED)}")
        return Job(**before)
    if samples._job is None and options:
        raise e.invalid(
            f"these samples were made with {', '.join(options)}, and do not know the values; give "
            f"before={{{options[0]!r}: ...}}"
        )
    return samples._job or Job()


def _is_chosen(name: str, value: Any) -> bool:
    return bool(value != 20) if name == "pool_ratio" else value is not None


def _is_empty(points: ExistingLike) -> bool:
    return (len(points) if isinstance(points, Samples) else np.size(points[0])) == 0


def _places(points: ExistingLike | None) -> ExistingLike | None:
    """Returns faces and weights without positions, which are those before an edit."""
    if isinstance(points, Samples):
        assert points.face_index is not None and points.barycentric is not None
        return points.face_index, points.barycentric
    return points


def _existing(surface: Surface, existing: ExistingLike | None) -> NDArray[Any]:
    """Returns given samples as the library takes them; none for an empty pair or set."""
    if existing is not None and _is_empty(existing):
        return np.empty(0, POINT)
    return existing_of(surface, existing)


def _avoided(
    surface: Surface, avoid: AvoidLike | None
) -> tuple[NDArray[Any], NDArray[np.float64]]:
    """Returns points to avoid and radii as the library takes them; none for empty points."""
    if isinstance(avoid, (tuple, list)) and len(avoid) == 2 and _is_empty(avoid[0]):
        return avoided_of(surface, None)
    return avoided_of(surface, avoid)


def _mesh_on(surface: Surface) -> Mesh:
    mesh = Mesh.__new__(Mesh)
    mesh._prepare(surface)
    mesh.warnings = ()  # They were shown when the samples were made.
    return mesh


def _target(
    source: Surface, to: ArrayLike | MeshLike | None, to_faces: Faces | None
) -> Mesh | None:
    """Returns the edited mesh; None for the one before."""
    if to is None:
        if to_faces is not None:
            raise TypeError("to_faces are of an edited mesh whose vertices are given")
        return None
    if is_mesh(to):
        return mesh_of(to, to_faces, None, False)
    corners = source.own_corners() if to_faces is None else to_faces
    return Mesh(to, corners, weld=source.weld, keep_seams=source.keep_seams)
