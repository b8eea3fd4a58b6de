"""Sampling many meshes as one job."""

from __future__ import annotations

import ctypes
import os
import re
import reprlib
from collections.abc import Iterator, Sequence
from ctypes import byref, c_double
from typing import Any, Iterable

import numpy as np
from numpy.typing import ArrayLike

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._devices import DeviceLike
from ._existing import AvoidLike, ExistingLike, avoided_of, existing_of
from ._features import Features
from ._mesh import Mesh, keys_of, mask_of, mesh_of
from ._oddities import oddities_of_set, warn, warn_of_whole_mask
from ._protocols import MeshLike
from ._radii import radii_of
from ._record import Record, recorded
from ._results import first_of, samples_of_parts
from ._running import CountSearch, ProgressCallback, Runs
from ._samples import Samples
from ._values import check_exact, check_pool, distance_of, integer, listed


class _Job:
    """One mesh of many, and how it is sampled."""

    def __init__(
        self,
        mesh: Mesh,
        distance: float | None,
        count: float | None,
        exact: bool,
        seed: int,
        density: ArrayLike | None,
        radius_factor: ArrayLike | None,
        face_keys: ArrayLike | None,
        face_mask: ArrayLike | None,
        existing: ExistingLike | None,
        avoid: AvoidLike | None,
        pool_ratio: float,
        features: Features | None,
    ) -> None:
        self.mesh, self.seed = mesh, seed
        self.index = 0  #: Of the mesh, among all.
        self._radii = radii_of(mesh, density, radius_factor)
        self.distance_part = 1.0 if self._radii is None else self._radii.distance_part
        self._keys = None if face_keys is None else keys_of(mesh, face_keys)
        self._mask = None if face_mask is None else mask_of(mesh._surface, face_mask)
        warn_of_whole_mask(self._mask)
        self._settled: object = None  # What the library reads.
        self.existing = existing_of(mesh._surface, existing)
        self._avoided, self._avoided_radii = avoided_of(mesh._surface, avoid)
        if count is not None and len(self.existing) >= count:
            raise e.invalid(f"count is {count}, but {len(self.existing)} existing samples count too")
        radii = None if self._radii is None else self._radii.handle.value
        self.has_radii = self._radii is not None
        self.params = s.SurfaceParams(
            seed=seed,
            pool_ratio=float(pool_ratio),
            radii=radii,
            face_keys=None if self._keys is None else self._keys.ctypes.data,
            face_mask=None if self._mask is None else self._mask.ctypes.data,
            existing=self.existing.ctypes.data,
            existing_count=len(self.existing),
            avoid=self._avoided.ctypes.data,
            avoid_radii=self._avoided_radii.ctypes.data,
            avoid_count=len(self._avoided),
        )
        if features is not None and density is not None:
            raise e.invalid("features take no density; give radius_factor to vary the distance")
        self._features = features
        self.search: CountSearch | None = None
        if distance is None:
            distance = self._distance_for(float(count or 0))
            self.search = CountSearch(float(count or 0), distance, exact)
        else:
            distance /= self.distance_part
        self.params.min_distance = distance
        self._distance_of_one = self._distance_for(1)
        self.result: Samples | None = None
        self._count = count
        self._exact_count = count if exact and count else 0

    def _distance_for(self, count: float) -> float:
        found = c_double()
        c.call(
            "geodisk_distance_for_count",
            self.mesh._handle.value,
            self.params.radii,
            self.params.face_mask,
            count,
            byref(found),
        )
        return found.value

    def candidates(self) -> float:
        """Returns about how many candidates its next run draws."""
        distance = float(self.params.min_distance)
        samples = (self._distance_of_one / distance) ** 2 if distance > 0 else 0.0
        return samples * float(self.params.pool_ratio)

    def told_distance(self) -> float:
        """Returns the distance as :func:`sample` has it, see Radii."""
        return float(self.params.min_distance) * self.distance_part

    def settle(self) -> None:
        """Adds samples on features to the existing ones, at the distance of the next run."""
        self.params.existing, self.params.existing_count = (
            self.existing.ctypes.data,
            len(self.existing),
        )
        if self._features is not None:
            self._settled = self._features.settle(self.params, len(self.existing))

    def take(self, found: Samples) -> bool:
        """Takes the samples of a run. Returns whether another one is needed."""
        if self._features is not None:
            found = self._features.marked(found, len(self.existing), self.params.existing_count)
        if self.search is None:
            self.result = found
            return False
        self.search.note(found, len(found))
        best = self.search.best
        self.result = best if best is None else first_of(best, self._exact_count)
        self.params.min_distance = self.search.next
        return self.search.next > 0

    def warn(self, prefix: str) -> None:
        """Shows warnings about its samples."""
        assert self.result is not None
        found = oddities_of_set(
            self.result,
            self.mesh._handle,
            self._count,
            mask=self._mask,
            existing=len(self.existing),
            avoids=len(self._avoided) > 0,
        )
        warn([e.GeodiskWarning(f"{prefix}{one}", one.kind, one.count) for one in found])


def sample_many(
    meshes: Iterable[MeshLike | tuple[ArrayLike, Any]],
    *,
    min_distance: float | Sequence[float] | None = None,
    radius: float | Sequence[float] | None = None,
    count: float | Sequence[float] | None = None,
    exact: bool = False,
    seed: int | Sequence[int] = 0,
    density: Sequence[ArrayLike | None] | None = None,
    radius_factor: Sequence[ArrayLike | None] | None = None,
    face_keys: Sequence[ArrayLike | None] | None = None,
    face_mask: Sequence[ArrayLike | None] | None = None,
    existing: Sequence[ExistingLike | None] | None = None,
    avoid: Sequence[AvoidLike | None] | None = None,
    features: float | None = None,
    pool_ratio: float = 20,
    weld: bool | float = False,
    keep_seams: bool = False,
    columns: str | Sequence[str] = (),
    attributes: str | Sequence[str] = (),
    texture: str | os.PathLike[str] | None = None,
    normals: str = "face",
    frames: bool = False,
    mesh_format: str | None = None,
    allow_outside: bool = False,
    device: DeviceLike | None = None,
    progress: bool | ProgressCallback = False,
    **others: object,
) -> list[Samples]:
    """Samples several meshes together, which is faster than sampling them separately.

    Each mesh gets the same samples as from :func:`sample`. Many meshes take several jobs.

    Parameters
    ----------
    meshes : iterable of meshes
        Each is a :class:`Mesh`, a path, an object of another package, or a pair of vertices and
        faces, as for :func:`sample`. A :class:`Mesh` may appear several times.
    min_distance, radius, count, seed : number, or a sequence with one per mesh
        As for :func:`sample`.
    density, radius_factor, face_keys, face_mask, existing, avoid : sequence of one per mesh, or None
        As for :func:`sample`; None for a mesh without.
    exact, features, pool_ratio, weld, keep_seams, columns, attributes, texture, normals, frames,
    mesh_format, allow_outside, device, progress
        As for :func:`sample`, for all meshes. The other parameters of :func:`sample` are for single
        meshes.

    Returns
    -------
    list of Samples
        Samples in the order of the meshes. Their reports describe the whole job of a mesh.

    Raises
    ------
    InvalidArgument, MeshRejected, TypeError and the others of :func:`sample`
        With ``mesh 3: `` before the message if the error concerns one mesh.

    Examples
    --------
    >>> import geodisk
    >>> corners = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]
    >>> mesh = geodisk.Mesh(corners, [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
    >>> a, b = geodisk.sample_many([mesh, mesh], min_distance=0.5, seed=[1, 2])
    >>> alone = geodisk.sample(mesh, min_distance=0.5, seed=2)
    >>> bool((b.points == alone.points).all())
    True
    """
    _refuse(others)
    record = Record(texture, normals, frames)
    several = listed(meshes)
    if several is None:
        raise TypeError(f"meshes is {reprlib.repr(meshes)}, not a list of meshes")
    given = several
    n = len(given)
    distances = [
        _each(values, name, n)
        for name, values in (("min_distance", min_distance), ("radius", radius), ("count", count))
    ]
    seeds = _each(seed, "seed", n)
    densities, keys = _each_array(density, "density", n), _each_array(face_keys, "face_keys", n)
    factors = _each_array(radius_factor, "radius_factor", n)
    masks = _each_array(face_mask, "face_mask", n)
    kept = _each_array(existing, "existing", n)
    avoided = _each_array(avoid, "avoid", n)

    def job_at(i: int) -> _Job:
        of_mesh = [values[i] for values in distances]
        distance = distance_of(*of_mesh)
        check_exact(exact, of_mesh[2])
        check_pool(of_mesh[2], pool_ratio)
        mesh = _mesh_of(
            given[i], weld, keep_seams, columns, mesh_format, attributes, record, allow_outside
        )
        return _Job(
            mesh,
            distance,
            of_mesh[2],
            exact,
            integer(seeds[i], "seed", 2**64 - 1),
            densities[i],
            factors[i],
            keys[i],
            masks[i],
            kept[i],
            avoided[i],
            pool_ratio,
            None if features is None else Features(features, mesh, device),
        )

    jobs = [_named(i, job_at) for i in range(n)]
    for i, job in enumerate(jobs):
        job.index = i
    with Runs(device, progress) as runs:
        active = jobs
        while active:
            active = [job for group in _groups(active) for job in _run(runs, group)]
    for i, job in enumerate(jobs):
        job.warn(f"mesh {i}: ")
    return [recorded(job.result, job.mesh, record) for job in jobs if job.result is not None]


#: Parameters of sample() that one job of several meshes cannot have.
_OF_ONE_MESH = (
    "darts",
    "stop_count",
    "maximal",
    "order",
    "levels",
    "level_factor",
    "classes",
    "metric",
    "edge_lengths",
)


def _refuse(others: dict[str, object]) -> None:
    """Raises TypeError if there are parameters that sample_many() has not."""
    for name in others:
        raise TypeError(
            f"sample_many() takes no {name}; call sample() for each mesh"
            if name in _OF_ONE_MESH
            else f"sample_many() got an unexpected keyword argument {name!r}"
        )


#: What one run takes, unless a single mesh has more: every device binds as much. A run of more is no
#: faster, also on a wide device.
_RUN_FACES = 1 << 18
_RUN_CANDIDATES = 1 << 21


def _groups(jobs: list[_Job]) -> Iterator[list[_Job]]:
    """Yields jobs that one run takes: of as many coordinates, and all with radii or none."""
    kinds: dict[tuple[int, bool], list[_Job]] = {}
    for job in jobs:
        kind = job.mesh._surface.dimension(), job.has_radii
        kinds.setdefault(kind, []).append(job)
    for of_kind in kinds.values():
        group: list[_Job] = []
        faces, candidates = 0, 0.0
        for job in of_kind:
            own_faces, own_candidates = len(job.mesh.triangles), job.candidates()
            faces, candidates = faces + own_faces, candidates + own_candidates
            if group and (faces > _RUN_FACES or candidates > _RUN_CANDIDATES):
                yield group
                group, faces, candidates = [], own_faces, own_candidates
            group.append(job)
        yield group


def _run(runs: Runs, jobs: list[_Job]) -> list[_Job]:
    """Samples the meshes of jobs. Returns those that need another run."""
    found = samples_of_parts(
        runs.run(_domain(jobs)),
        [
            (job.seed, job.told_distance(), job.mesh._surface, len(job.existing))
            for job in jobs
        ],
    )
    return [job for job, samples in zip(jobs, found) if job.take(samples)]


def _domain(jobs: list[_Job]) -> c.Handle:
    for job in jobs:
        job.settle()
    parts = (s.SurfacePart * len(jobs))()
    for part, job in zip(parts, jobs):
        part.struct_size = ctypes.sizeof(s.SurfacePart)
        part.mesh = job.mesh._handle.value
        part.params = ctypes.pointer(job.params)
    try:
        return c.Handle("domain", "geodisk_domain_surfaces", parts, len(jobs))
    except e.Error as error:
        raise _of_mesh(error, jobs) from None


def _of_mesh(error: e.Error, jobs: list[_Job]) -> e.Error:
    """Returns an error of a job with the number of the mesh in place of that of its surface."""
    said = str(error)
    surface = re.match(r"surface (\d+): ", said)
    if surface is None:
        return error
    index = jobs[int(surface[1])].index
    return type(error)(f"mesh {index}: {said[surface.end():]}", error.status, error.element)


def _named(index: int, make: Any) -> Any:
    """Returns `make(index)`; errors name the mesh."""
    try:
        return make(index)
    except e.Error as error:
        message = f"mesh {index}: {error}"
        raise type(error)(message, error.status, error.element) from error
    except (TypeError, OSError) as error:
        raise type(error)(f"mesh {index}: {error}") from error


def _mesh_of(
    given: Any,
    weld: bool | float,
    keep_seams: bool,
    columns: str | Sequence[str],
    mesh_format: str | None,
    attributes: str | Sequence[str],
    record: Record,
    allow_outside: bool,
) -> Mesh:
    vertices, faces = given, None
    if isinstance(given, (tuple, list)):
        if len(given) != 2:
            raise TypeError("a mesh is a pair of vertices and faces, or brings its faces")
        vertices, faces = given
    return mesh_of(
        vertices, faces, None, weld, keep_seams, columns, mesh_format, attributes, record,
        allow_outside,
    )


def _each(values: Any, name: str, n: int) -> list[Any]:
    """Returns one value for each of n meshes."""
    if isinstance(values, np.ndarray):
        values = values.tolist()
    if not isinstance(values, (Sequence, range)) or isinstance(values, str):
        return [values] * n
    if len(values) != n:
        raise e.invalid(f"{name} has {len(values)} values for {n} meshes")
    return list(values)


def _each_array(arrays: Any, name: str, n: int) -> list[Any]:
    """Returns one array, or None, for each of n meshes."""
    if arrays is None:
        return [None] * n
    several = listed(arrays)
    if several is None:
        raise TypeError(f"{name} is {reprlib.repr(arrays)}, not a list with one array for each mesh")
    if len(several) != n:
        raise e.invalid(f"{name} has {len(several)} arrays for {n} meshes")
    return several
