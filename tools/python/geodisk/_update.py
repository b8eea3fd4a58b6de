"""Samples that follow an edit of their mesh."""

from __future__ import annotations

import copy
import ctypes
import dataclasses
import math
import os
from typing import Any, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._attributes import Attribute
from ._devices import DeviceLike, name_of
from ._existing import AvoidLike, ExistingLike, avoided_of, points_of
from ._inputs import mesh_under
from ._job import FOLLOWED, MASK_DIGEST, Job, JobFrame, is_chosen, joins_of
from ._mesh import Mesh, is_mesh, joins_for, mesh_of
from ._protocols import Faces, MeshLike
from ._radii import one_of
from ._record import Inherited, Record, check_record, coloured, recorded
from ._results import samples_of
from ._running import ProgressCallback
from ._samples import Samples
from ._searching import searched
from ._surface import Surface
from ._values import check_pool, listed
from ._wanted import OnMesh
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
    attributes: str | Sequence[str] | None = None,
    texture: str | os.PathLike[str] | None = None,
    normals: str | None = None,
    frames: bool | float | str | None = None,
    up: str | None = None,
    vertices: ArrayLike | MeshLike | None = None,
    faces: Faces | None = None,
    weld: bool | float = False,
    keep_seams: bool = False,
    allow_outside: bool = False,
    device: DeviceLike | None = None,
    progress: bool | ProgressCallback = False,
) -> Samples:
    """Returns the samples of an edited mesh, and decides only what the edit can reach.

    The samples are those of a whole run over the edited mesh with the same seed and distance, in
    the frame that decided the samples before. An edit that makes an edge longer than that frame
    allows, or the first edge of more than two faces, decides all samples again, as :func:`sample`
    does: see "Updates" in the documentation.

    Parameters
    ----------
    samples : Samples
        All samples of :func:`sample` on the mesh before, existing ones first. Not with darts, stop_count,
        exact, classes, features, maximal, another order or another metric.
    to : array_like of float, shape (v, d), or a mesh
        The edited mesh, or positions of its vertices; the mesh before by default.
    to_faces : array_like of int, optional
        Faces of the edited mesh; those of the mesh before by default.
    density, radius_factor, face_keys, face_mask, existing, avoid
        Parameters of :func:`sample` on the edited mesh. By default those of the mesh before, to which
        samples of :func:`sample` refer. A density must keep its largest and least value. An empty
        pair as `existing` or as points of `avoid` removes those before. Needed for an edited mesh
        of other faces, or of another number of vertices, if the samples were made with them.
    before : mapping, optional
        The same parameters on the mesh before, by name. Needed for samples that were read from a file,
        if they were made with any. `pool_ratio` may be there too; files tell it.
    attributes, texture, normals, frames, up
        As for :func:`sample`. By default what the samples have. Where only positions change,
        attributes and colours are those of the mesh before.
    vertices, faces, weld, keep_seams
        Mesh before the edit, as for :func:`sample`. Needed for samples that were read from a file.
    allow_outside : bool
        As for :class:`Mesh`, of both meshes.
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
        For samples that are not on their mesh, of another run than above, or not all of a run.
    Others as :func:`sample`.

    Warns
    -----
    GeodiskWarning
        For attributes, columns and normals that samples of the edited mesh cannot have, such as
        attributes of your own.

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
    wanted = Inherited(texture, normals, frames, up, attributes)
    wanted.given()  # Raises for what is wrong.
    before_edit = _mesh_before(
        samples, vertices, faces, weld, keep_seams, allow_outside, wanted
    )
    if samples.seed is None or not samples.min_distance > 0:
        raise e.invalid("these samples do not know their seed and minimum distance")
    job = _job_of(samples, before)
    _check_radii(job, density, radius_factor)
    given = dict(density=density, radius_factor=radius_factor, existing=existing, avoid=avoid)
    given.update(face_keys=face_keys, face_mask=face_mask)
    chosen = _without_empties({name: x for name, x in given.items() if x is not None})
    _check_joins(samples, before_edit)
    old = _Side(before_edit, job, samples)
    if samples._told.get(MASK_DIGEST, old.mask_digest) != old.mask_digest:
        raise e.invalid("the samples were made with another face_mask; give it as it was")
    edited = dataclasses.replace(job, **{**old.heritage, **chosen})
    mesh, record, is_moved = _edited_mesh(samples, old.mesh, to, to_faces, allow_outside, wanted)
    _check_inherited(old.mesh, mesh, job, chosen)
    new = _Side(mesh, edited, samples, old)
    points = points_of(old.mesh._handle, samples, "samples", True)
    info = s.UpdateInfo()
    frames_of_run: list[JobFrame] = []

    def find(sampler: ctypes.c_void_p, hear: Any) -> c.Handle:
        updater = c.Handle(
            "updater",
            "geodisk_updater_create_edited",
            *old.arguments(),
            *new.arguments(),
            None if samples._frame is None else samples._frame.to_bytes(),
            points,
            len(points),
        )
        rest = (None, 0, hear, None, info)
        c.call("geodisk_update", updater, sampler, *new.arguments(), *rest)
        frames_of_run.append(JobFrame.found("geodisk_updater_frame", updater))
        return c.Handle("samples", "geodisk_updater_samples", updater)

    made = searched(name_of(device), progress, find)
    file = old.mesh._source if is_moved else mesh._source
    there = samples_of(
        made,
        samples.seed,
        mesh._surface,
        given=samples.min_distance,
        _job=dataclasses.replace(edited, source=file),
        _told=_told_of(samples, new),
        _frame=frames_of_run[-1],
    )
    there.report["options"] = [
        name for name in FOLLOWED if is_chosen(name, getattr(edited, name))
    ]
    there.report["update"] = {
        name: getattr(info, name) for name in ("rounds", "faces", "uploaded", "removed", "added")
    }
    there = recorded(there, mesh, record)
    if is_moved:
        there = coloured(there, old.mesh, wanted.inherited(samples).texture)
    wanted.warn_of_lost(samples, there)
    return there


def _told_of(samples: Samples, new: _Side) -> dict[str, str]:
    """Returns what headers tell of the samples before, with the walls and the mask after the edit."""
    own = {"walls": new.mesh._surface.walls, MASK_DIGEST: new.mask_digest}
    kept = {name: value for name, value in samples._told.items() if name not in own}
    return {**kept, **{name: value for name, value in own.items() if value}}


def _check_joins(samples: Samples, mesh: Mesh) -> None:
    """Raises if the mesh before is joined in another way than that of the samples."""
    own = joins_of(mesh._surface)
    for name in ("weld", "keep_seams", "walls"):
        told = samples._told.get(name)
        if told != own.get(name):
            made = f"with {name}={told}" if told else f"without {name}"
            raise e.invalid(f"the samples were made {made}; give the mesh before in the same way")


class _Side(OnMesh):
    """A mesh and its parameters as the library takes them."""

    def __init__(
        self, mesh: Mesh, job: Job, samples: Samples, before: _Side | None = None
    ) -> None:
        super().__init__(mesh, job)
        self.mesh = mesh
        kept, (avoided, radii) = self.existing, avoided_of(mesh._handle, job.avoid)
        #: What others inherit, by faces and weights, since positions are those before an edit.
        self.heritage = {
            "existing": None if job.existing is None else (kept["face"], kept["weights"]),
            "avoid": None if job.avoid is None else ((avoided["face"], avoided["weights"]), radii),
        }
        distance = samples.min_distance / self.part
        if before is not None and before.part != self.part:
            raise e.invalid(
                "the density has another largest or least value than before, by which all radii go, so "
                "all samples change; sample the mesh again"
            )
        frame = samples._frame
        exact = job.distance if frame is None else frame.min_distance()  # Before it was rounded.
        if exact is not None:
            if not math.isclose(exact, distance, rel_tol=1e-12):
                raise e.invalid(f"these samples were not made {samples.min_distance} apart")
            distance = exact
        assert samples.seed is not None
        self._params = self.params(
            distance, samples.seed, (avoided, radii), pool_ratio=float(job.pool_ratio)
        )

    def arguments(self) -> tuple[Any, Any]:
        return self.mesh._handle, self._params


def _job_of(samples: Samples, before: Mapping[str, Any] | None) -> Job:
    """Returns what the samples were made with."""
    options = samples.report.get("options", [])
    if SELECTION in options or not samples._is_whole():
        raise e.invalid("some samples of the set were removed, added or changed; give all of it")
    if others := [name for name in options if name not in FOLLOWED]:
        raise e.invalid(
            f"samples made with {', '.join(others)} cannot be updated; sample the mesh again"
        )
    given = _parameters(before)
    ratio = samples._told.get("pool_ratio")
    job = samples._job or Job(pool_ratio=_ratio_of(ratio))
    if given.get("pool_ratio", job.pool_ratio) != job.pool_ratio:
        raise e.invalid(
            f"the samples were made with the pool_ratio {job.pool_ratio:g}, not {given['pool_ratio']}"
        )
    known = {*given} if ratio is None else {*given, "pool_ratio"}
    if samples._job is None and (unknown := [name for name in options if name not in known]):
        raise e.invalid(
            f"these samples were made with {', '.join(unknown)}, and do not know the values; give "
            f"before={{{unknown[0]!r}: ...}}"
        )
    return dataclasses.replace(job, **given)


def _ratio_of(told: str | None) -> float:
    """Returns the pool ratio that a header tells."""
    if told is None:
        return 20
    try:
        ratio = float(told)
        check_pool(None, ratio)
    except ValueError:  # InvalidArgument is one.
        raise e.invalid(f"the header of the samples has a wrong pool_ratio: {told!r}") from None
    return ratio


def _parameters(before: Mapping[str, Any] | None) -> dict[str, Any]:
    """Returns parameters of the run before, after a check of their names."""
    if before is None:
        return {}
    if not isinstance(before, Mapping):
        raise TypeError(f"before is {before!r}, not a dict such as {{'pool_ratio': 10}}")
    if unknown := [name for name in before if name not in FOLLOWED]:
        raise TypeError(f"before has {unknown[0]!r}, none of {', '.join(FOLLOWED)}")
    if "pool_ratio" in before:
        check_pool(None, before["pool_ratio"])
    return _without_empties(before)


def _without_empties(given: Mapping[str, Any]) -> dict[str, Any]:
    """Returns parameters with None for existing samples and points to avoid of which there are none."""
    found, avoid = dict(given), given.get("avoid")
    if _is_empty(given.get("existing")):
        found["existing"] = None
    if isinstance(avoid, (tuple, list)) and len(avoid) == 2 and _is_empty(avoid[0]):
        found["avoid"] = None
    return found


def _is_empty(points: Any) -> bool:
    if isinstance(points, (tuple, list)) and len(points) == 2:
        faces = listed(points[0])
        return faces is not None and len(faces) == 0
    if isinstance(points, np.ndarray):
        return points.shape[:1] == (0,)
    return isinstance(points, (Samples, list)) and len(points) == 0


def _check_radii(job: Job, density: ArrayLike | None, radius_factor: ArrayLike | None) -> None:
    """Raises if radii vary in another way than before."""
    before, now = one_of(job.density, job.radius_factor), one_of(density, radius_factor)
    if now is not None and now != before:
        made = f"with {before}" if before else "without density and radius_factor"
        raise e.invalid(
            f"the samples were made {made}, so {now} changes all of them; sample the mesh with {now}, "
            "and update those samples"
        )


def _check_inherited(old: Mesh, new: Mesh, job: Job, chosen: Mapping[str, Any]) -> None:
    """Raises for what the samples were made with, if it does not belong to the edited mesh."""

    def fail(name: str, what: str) -> None:
        raise e.invalid(
            f"the samples were made with {name}, and the edited mesh has other {what}; give {name} "
            "for them"
        )

    if not np.array_equal(old._surface.own_corners(), new._surface.own_corners()):
        for name in ("face_keys", "face_mask", "existing", "avoid"):
            if getattr(job, name) is not None and name not in chosen:
                fail(name, "faces")
    if old._surface.vertex_count() != new._surface.vertex_count():
        for name in ("density", "radius_factor"):
            if getattr(job, name) is not None and name not in chosen:
                fail(name, "vertices")


def _mesh_before(
    samples: Samples,
    vertices: ArrayLike | MeshLike | None,
    faces: Faces | None,
    weld: bool | float,
    keep_seams: bool,
    allow_outside: bool,
    wanted: Inherited,
) -> Mesh:
    """Returns the mesh before, with what its file has for samples."""
    is_path = isinstance(vertices, (str, os.PathLike)) and faces is None
    if vertices is not None and is_path and isinstance(samples, Samples):
        path = vertices
        mesh, _ = wanted.mesh(
            samples,
            tuple(name for name in samples.attributes if name not in ("frames", "cover", "row")),
            lambda record, read: mesh_of(
                path, weld=weld, keep_seams=keep_seams, attributes=read, record=record,
                allow_outside=allow_outside,
            ),
        )
        return mesh
    found = mesh_under(samples, vertices, faces, None, weld, keep_seams)
    if found is None:
        raise e.invalid("samples in a box have no mesh")
    if vertices is None and samples._job is not None:
        found._source = samples._job.source
    return found


def _edited_mesh(
    samples: Samples,
    old: Mesh,
    to: ArrayLike | MeshLike | None,
    to_faces: Faces | None,
    allow_outside: bool,
    wanted: Inherited,
) -> tuple[Mesh, Record, bool]:
    """Returns the edited mesh, what to add to samples, and whether only positions are given."""
    source = old._surface
    if to is None:
        if to_faces is not None:
            raise TypeError("to_faces are of an edited mesh whose vertices are given")
    is_moved = to is not None and not is_mesh(to) and to_faces is None
    if source.walls and to is not None and not is_mesh(to):
        raise TypeError("the mesh before has walls; give the edited one as a geodisk.Mesh with its own")

    def make(record: Record, read: Sequence[str]) -> Mesh:
        if to is not None and is_mesh(to):
            return mesh_of(
                to, to_faces, **joins_for(to, source), attributes=read, record=record,
                allow_outside=allow_outside,
            )
        own = _named(source, read)
        if to is None:
            check_record(old, record)
            mesh = copy.copy(old)
            mesh._surface = dataclasses.replace(source, attributes=own)
            return mesh
        corners = source.own_corners() if to_faces is None else to_faces
        mesh = Mesh(to, corners, **joins_for(to, source), _record=record)
        if to_faces is None:
            columns = {name: x for name, x in source.columns.items() if name != "part"}
            mesh._surface = dataclasses.replace(
                mesh._surface,
                polygons=source.polygons,
                given_faces=source.given_faces,
                attributes=own,
                columns=columns,
            )
        return mesh

    mesh, record = wanted.mesh(samples, tuple(source.attributes), make)
    return mesh, record, is_moved


def _named(surface: Surface, attributes: Sequence[str]) -> dict[str, Attribute]:
    """Returns attributes of a surface by name."""
    wanted = surface.attributes if "all" in attributes else attributes
    if missing := [name for name in wanted if name not in surface.attributes]:
        raise e.invalid(f"the mesh before has no attribute {missing[0]!r}; give the path of its file")
    return {name: surface.attributes[name] for name in wanted}
