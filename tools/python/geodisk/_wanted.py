"""What is asked for on meshes: checked, as the library takes it, and the samples that they get."""

from __future__ import annotations

import dataclasses
import reprlib
from collections.abc import Sequence
from ctypes import c_double, c_int32, c_uint32
from types import SimpleNamespace
from typing import Any, Callable, Iterator, Mapping, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._arrays import mask_digest
from ._classes import Classes, ClassPlaces, has_classes, values_of
from ._existing import existing_of
from ._job import (
    FOLLOWED,
    MASK_DIGEST,
    Job,
    JobFrame,
    is_chosen,
    joins_of,
    options,
    told_text,
    values,
)
from ._mesh import Mesh, attributes_with, keys_of, mask_of, mesh_of
from ._oddities import oddities_of_set, warn
from ._radii import one_of, radii_of
from ._record import Record, recorded
from ._results import report_of, samples_of
from ._running import serve
from ._samples import Samples
from ._surface import Surface
from ._values import (
    check_exact,
    check_fields,
    check_pool,
    choice,
    degrees_of,
    distance_of,
    flag,
    integer,
    levels_of,
    listed,
    number,
    seed_of,
)

T = TypeVar("T")


class OnMesh:
    """Parameters that updates follow, as the library takes them on a mesh."""

    def __init__(self, mesh: Mesh, given: Any, prefix: str = "") -> None:
        self._radii = radii_of(mesh, given.density, given.radius_factor, prefix)
        self.part = self._radii.distance_part
        self._keys = None if given.face_keys is None else keys_of(mesh, given.face_keys)
        self.mask = None if given.face_mask is None else mask_of(mesh._surface, given.face_mask)
        self.mask_digest = "" if self.mask is None else mask_digest(self.mask)
        self.existing = existing_of(mesh._handle, given.existing)

    def params(
        self, distance: float, seed: int, avoid: tuple[NDArray[Any], NDArray[np.float64]], **others: Any
    ) -> s.SurfaceParams:
        """Returns them with the distance of the run, and with points to avoid and their radii."""
        return s.SurfaceParams(
            min_distance=distance,
            seed=seed,
            radii=self._radii.handle,
            face_keys=self._keys,
            face_mask=self.mask,
            existing=self.existing,
            existing_count=len(self.existing),
            avoid=avoid[0],
            avoid_radii=avoid[1],
            avoid_count=len(avoid[0]),
            **others,
        )


class Wanted:
    """Samples of one mesh that are asked for. Parameters are those of :func:`sample`.

    The mesh is read for `record`. Warnings begin with `prefix`.
    """

    def __init__(
        self, vertices: Any, faces: Any, record: Record, given: Mapping[str, Any], prefix: str = ""
    ) -> None:
        a = SimpleNamespace(**given)
        min_distance = a.min_distance
        params_numbers = numbers_in(s.SurfaceParams, given)
        request_numbers = numbers_in(s.Request, given)
        darts = int(params_numbers["darts"])
        kinds = None if a.classes is None else Classes(a.classes)
        if kinds is not None and kinds.largest is not None:
            if min_distance is not None or a.radius is not None:
                raise e.invalid("a table of classes takes no min_distance and no radius")
            if a.count is None:
                min_distance = kinds.largest  # Else the table is scaled.
        distance = distance_of(min_distance, a.radius, a.count, darts)
        seed = seed_of(a.seed)
        check_exact(a.exact, a.count)
        check_pool(a.count, a.pool_ratio, darts)
        choice(a.metric, "metric", s.METRICS)
        choice(a.order, "order", ("dart", "progressive", "farthest"))
        radii_name = one_of(a.density, a.radius_factor)
        self._options = [name for name in options() if is_chosen(name, given[name])]
        check_fields(
            {
                **{name: name for name in self._options},
                "count": None if a.count is None else "count",
                "is_exact": "exact" if a.exact else None,
                "radii": radii_name,
                "class_factors": "classes" if kinds is not None and kinds.count > 1 else None,
                a.order: f"order='{a.order}'",
                "metric": f"metric='{a.metric}'" if a.metric != "geodesic" else None,
            }
        )
        in_levels = levels_of(a.order, a.levels, a.level_factor)
        degrees = 0.0 if a.features is None else degrees_of(a.features)

        named = (a.density, a.radius_factor, *values_of(a.class_densities))
        self.mesh = mesh = mesh_of(
            vertices,
            faces,
            **{name: given[name] for name in _OF_MESH},
            attributes=attributes_with(a.attributes, vertices, *named),
            record=record,
            prefix=prefix,
        )
        if a.metric != "geodesic" and mesh._surface.walls:
            both = f"metric='{a.metric}' and walls"
            raise e.invalid(f"{both} exclude each other: walls are for paths along the surface")
        on = OnMesh(mesh, a, prefix)
        kept = on.existing
        places = ClassPlaces(
            mesh,
            kinds,
            a.avoid,
            class_masks=a.class_masks,
            class_densities=a.class_densities,
            class_avoid=a.class_avoid,
        )
        if a.count is not None and len(kept) >= a.count:
            raise e.invalid(f"count is {a.count}, but {len(kept)} existing samples count too")
        self._params = params = on.params(
            (distance or 0.0) / on.part,
            seed,
            (places.points, places.radii),
            metric=s.METRICS[a.metric],
            **params_numbers,
        )
        own_classes = None
        if kinds is not None and kinds.count > 1:
            own_classes = kinds.existing_of(a.existing, len(kept))
            params.class_factors = kinds.factors
            params.class_count = kinds.count
            params.existing_classes = own_classes
            params.class_shares = places.shares
            params.avoid_classes = places.avoid_classes
        #: As the library takes it.
        self.request = s.Request(
            params=params,
            count=a.count or 0.0,
            order=s.ORDERS[a.order],
            features=degrees,
            **request_numbers,
        )
        self._lacks_classes = own_classes is not None and len(kept) > 0 and not has_classes(a.existing)
        self._class_counts = None
        if a.class_counts is not None:
            if own_classes is None or kinds is None:
                raise e.invalid("class_counts is for classes, two or more")
            self._class_counts = kinds.counts_of(a.class_counts)
            self.request.class_counts = self._class_counts
        if in_levels is not None:
            self.request.levels, self.request.level_factor = in_levels

        self._distance, self._seed, self._on, self._record = distance, seed, on, record
        self._existing, self._avoids, self._classes = len(kept), len(places.points) > 0, kinds
        self._asked, self._degrees, self._prefix = a, degrees, prefix
        self._told = joins_of(mesh._surface)
        for name in self._options:
            if name in values() and name not in _TOLD_BY_RUNS:
                self._told[name] = told_text(given[name])
        followed = {name: given[name] for name in FOLLOWED}
        self._job = Job(distance=None, source=mesh._source, **followed)

    def samples_of(self, made: c.Handle) -> Samples:
        """Returns the samples that were made, in the order asked for, after warnings about them."""
        report = report_of(made)
        run_distance, told = report["min_distance"], dict(self._told)
        if self._params.darts:
            told["darts"] = str(report["candidates"])
        if self._params.is_maximal:
            told["maximal"] = "certified" if report["is_certified"] else "not certified"
        if self._on.mask_digest:
            told[MASK_DIGEST] = self._on.mask_digest
        if report["cut"] and self._class_counts is None:
            told["exact"] = str(report["samples"])
        samples = samples_of(
            made,
            self._seed,
            self.mesh._surface,
            given=self._distance,
            distance_part=self._on.part,
            classes=self._classes,
            _job=dataclasses.replace(self._job, distance=run_distance),
            _told=told,
            _frame=self._frame_at(run_distance),
        )
        samples.report["options"] = self._options
        if self.request.at_vertices:
            samples.columns["vertex"] = vertices_at(samples, self.mesh._surface)
        self._warn(samples)
        return recorded(samples, self.mesh, self._record)

    def _frame_at(self, run_distance: float) -> JobFrame | None:
        """Returns the frame of a run whose distance samples say rounded, else None."""
        told = run_distance * self._on.part if self._distance is None else self._distance
        if told / self._on.part == run_distance:
            return None
        params = s.SurfaceParams.from_buffer_copy(self._params)
        params.min_distance, params.existing_count, params.stop_count = run_distance, 0, 0
        return JobFrame.found("geodisk_job_frame_of", self.mesh._handle, params)

    def _warn(self, samples: Samples) -> None:
        """Shows warnings about the samples that were made."""
        found = oddities_of_set(
            samples,
            self.mesh._handle,
            self._asked.count,
            self._params.stop_count,
            self._params.darts,
            self._on.mask,
            self._existing,
            self._avoids,
            self._degrees if samples.report["lacks_features"] else 0,
        )
        warn([*found, *self._oddities_of(samples)], self._prefix)

    def _oddities_of(self, samples: Samples) -> Iterator[e.GeodiskWarning]:
        """Returns what is odd about arguments that the program has not."""
        mask = self._on.mask
        if mask is not None and mask.size and mask.all():
            yield e.GeodiskWarning("face_mask leaves out no triangle", "mask_of_all", 1)
        if self._lacks_classes:
            text = "existing: the samples have no class, so they get class 0"
            yield e.GeodiskWarning(text, "no_classes", self._existing)
        if self._classes is None or self._classes.count < 2:
            return
        made = np.bincount(samples.columns["class"], minlength=self._classes.count)
        if len(samples) > 0:
            for number in np.flatnonzero(made == 0):
                yield e.GeodiskWarning(f"class {number} has no sample", "empty_class", 1)
        if self._class_counts is not None:
            for number in np.flatnonzero(made < self._class_counts):
                text = f"class {number} has {made[number]} of {self._class_counts[number]} samples"
                yield e.GeodiskWarning(text, "few_of_class", int(made[number]))


def vertices_at(samples: Samples, surface: Surface) -> NDArray[np.uint32]:
    """Returns the vertex that each sample is at, 4294967295 for one that is at none."""
    faces, weights = samples.face_index, samples.barycentric
    assert faces is not None and weights is not None
    vertices: NDArray[np.uint32]
    vertices = surface.indices()[faces, weights.argmax(axis=1)].astype(np.uint32)
    if surface.copied is not None and len(surface.copied):
        first = surface.vertex_count() - len(surface.copied)
        copies = vertices >= first
        vertices[copies] = surface.copied[vertices[copies] - first]
    vertices[weights.max(axis=1) < 1] = 2**32 - 1
    return vertices


_OF_MESH = ("edge_lengths", "weld", "keep_seams", "columns", "mesh_format", "allow_outside")

#: Numbers of structs that parameters of the same names do not tell alone.
_OWN = {"min_distance", "seed", "metric", "count", "order", "features", "levels", "level_factor"}

#: Options that headers tell by what a run came to.
_TOLD_BY_RUNS = {"darts", "stop_count", "exact", "maximal", "order"}


def numbers_in(struct: Any, given: Mapping[str, Any]) -> dict[str, int | float]:
    """Returns the fields of a struct that parameters of the same names tell, checked."""
    found: dict[str, int | float] = {}
    for field, kind in struct._fields_:
        name = field.removeprefix("is_")
        if name not in given or name in _OWN:
            continue
        if kind is c_uint32:
            found[field] = integer(given[name], name, 2**32 - 1)
        elif kind is c_double:
            found[field] = number(given[name], name)
        elif kind is c_int32:
            found[field] = int(flag(given[name], name))
    return found


def record_of(given: Mapping[str, Any]) -> Record:
    """Returns what arguments of :func:`sample` add to samples."""
    return Record(given["texture"], given["normals"], given["frames"], given["up"])


def sample_one(given: Mapping[str, Any]) -> Samples:
    """Returns the samples that arguments of :func:`sample` ask for, by name."""
    wanted = Wanted(given["vertices"], given["faces"], record_of(given), given)
    (made,) = serve(given["device"], given["progress"], [(wanted.mesh._handle, wanted.request)])
    return wanted.samples_of(made)


#: Parameters of :func:`sample_many` that have a number for each mesh.
_NUMBERS = ("min_distance", "radius", "count", "seed")

#: Parameters that have an array for each mesh.
_ARRAYS = (
    *("density", "radius_factor", "face_keys", "face_mask", "existing", "avoid"),
    *("class_masks", "class_densities", "class_avoid"),
)


def sample_each(given: Mapping[str, Any]) -> list[Samples]:
    """Returns the samples that arguments of :func:`sample_many` ask for, by name."""
    meshes, record = given["meshes"], record_of(given)
    all_meshes = listed(meshes)
    if all_meshes is None:
        raise TypeError(f"meshes is {reprlib.repr(meshes)}, not a list of meshes")
    several, n = all_meshes, len(all_meshes)
    own = {name: _each(given[name], name, n) for name in _NUMBERS}
    own |= {name: _each_array(given[name], name, n) for name in _ARRAYS}

    def wanted_at(i: int) -> Wanted:
        alone = {**given, **{name: x[i] for name, x in own.items()}}
        return Wanted(*_parts_of(several[i]), record, alone, _prefix(i))

    wanted = [_named(i, wanted_at) for i in range(n)]
    if not wanted:
        return []

    def run(_: int = 0) -> list[c.Handle]:
        requests = [(one.mesh._handle, one.request) for one in wanted]
        return serve(given["device"], given["progress"], requests)

    made = run() if n > 1 else _named(0, run)
    return [_named(i, lambda i: wanted[i].samples_of(made[i])) for i in range(n)]


def _prefix(index: int) -> str:
    return f"mesh {index}: "


def _named(index: int, make: Callable[[int], T]) -> T:
    """Returns `make(index)`; errors name the mesh."""
    try:
        return make(index)
    except e.Error as error:
        raise type(error)(f"{_prefix(index)}{error}", error.status, error.element) from error
    except OSError as error:
        if error.errno is None:
            raise type(error)(f"{_prefix(index)}{error}") from error
        reason = f"{_prefix(index)}{error.strerror}"
        raise type(error)(error.errno, reason, error.filename) from error
    except TypeError as error:
        raise type(error)(f"{_prefix(index)}{error}") from error


def _parts_of(given: Any) -> tuple[Any, Any]:
    """Returns the vertices and faces of a pair, or a mesh that brings its faces."""
    if not isinstance(given, (tuple, list)):
        return given, None
    if len(given) != 2:
        raise TypeError("a mesh is a pair of vertices and faces, or brings its faces")
    return given[0], given[1]


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
