"""What is asked for on one mesh: checked, as the library takes it, and the samples that it gets."""

from __future__ import annotations

import dataclasses
import inspect
from ctypes import addressof, byref
from typing import Any, Callable, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._class_places import ClassPlaces, values_of
from ._classes import Classes, ClassesLike
from ._devices import DeviceLike
from ._existing import AvoidLike, ExistingLike, existing_of
from ._farthest import put_farthest_first
from ._features import degrees_of
from ._job import Job, JobFrame, exact_text, joins_of
from ._levels import levels_of
from ._mesh import Mesh, attributes_with, keys_of, mask_of, mesh_of
from ._oddities import oddities_of_set, warn, warn_of_whole_mask
from ._radii import one_of, radii_of
from ._record import Record
from ._results import report_of, samples_of
from ._rules import check_fields
from ._running import ProgressCallback
from ._samples import Samples
from ._surface import Surface
from ._values import check_exact, check_pool, choice, distance_of, flag, integer, seed_of


class Wanted:
    """Samples of one mesh that are asked for. Parameters are those of :func:`sample`."""

    def __init__(
        self,
        read_mesh: Callable[[], Mesh],
        *,
        min_distance: float | None,
        radius: float | None,
        count: float | None,
        exact: bool,
        seed: int | None,
        density: ArrayLike | None,
        radius_factor: ArrayLike | None,
        pool_ratio: float,
        darts: int,
        stop_count: int,
        maximal: bool,
        order: str,
        levels: int | None,
        level_factor: float | None,
        face_keys: ArrayLike | None,
        face_mask: ArrayLike | None,
        existing: ExistingLike | None,
        avoid: AvoidLike | None,
        classes: ClassesLike | None,
        class_counts: Sequence[int] | None,
        class_masks: Mapping[int, ArrayLike] | None,
        class_densities: Mapping[int, ArrayLike] | None,
        class_avoid: Mapping[int, AvoidLike] | None,
        features: float | None,
        at_vertices: bool,
        metric: str,
    ) -> None:
        darts = integer(darts, "darts", 2**32 - 1)
        kinds = None if classes is None else Classes(classes)
        if kinds is not None and kinds.largest is not None:
            if min_distance is not None or radius is not None:
                raise e.invalid("a table of classes takes no min_distance and no radius")
            if count is None:
                min_distance = kinds.largest  # Else the table is scaled.
        distance = distance_of(min_distance, radius, count, darts)
        seed = seed_of(seed)
        stop_count = integer(stop_count, "stop_count", 2**32 - 1)
        check_exact(exact, count)
        check_pool(count, pool_ratio, darts)
        choice(metric, "metric", s.METRICS)
        choice(order, "order", ("dart", "progressive", "farthest"))
        maximal, at_vertices = flag(maximal, "maximal"), flag(at_vertices, "at_vertices")
        radii_name = one_of(density, radius_factor)
        chosen = {
            "pool_ratio": pool_ratio != 20,
            "darts": darts,
            "stop_count": stop_count,
            "exact": exact,
            "density": density is not None,
            "radius_factor": radius_factor is not None,
            "face_keys": face_keys is not None,
            "face_mask": face_mask is not None,
            "metric": metric != "geodesic",
            "classes": classes is not None,
            "class_counts": class_counts is not None,
            "class_masks": class_masks is not None,
            "class_densities": class_densities is not None,
            "class_avoid": class_avoid is not None,
            "features": features is not None,
            "at_vertices": at_vertices,
            "order": order != "dart",
            "maximal": maximal,
            "existing": existing is not None,
            "avoid": avoid is not None,
        }
        self._options = [name for name, is_chosen in chosen.items() if is_chosen]
        check_fields(
            {
                **{name: name for name in self._options},
                "count": None if count is None else "count",
                "is_exact": "exact" if exact else None,
                "radii": radii_name,
                "class_factors": "classes" if kinds is not None and kinds.count > 1 else None,
                order: f"order='{order}'",
                "metric": f"metric='{metric}'" if metric != "geodesic" else None,
            }
        )
        in_levels = levels_of(order, levels, level_factor)
        degrees = 0.0 if features is None else degrees_of(features)

        self.mesh = mesh = read_mesh()
        radii = radii_of(mesh, density, radius_factor)
        keys = None if face_keys is None else keys_of(mesh, face_keys)
        mask = None if face_mask is None else mask_of(mesh._surface, face_mask)
        warn_of_whole_mask(mask)
        kept = existing_of(mesh._handle, existing)
        places = ClassPlaces(
            mesh,
            kinds,
            avoid,
            class_masks=class_masks,
            class_densities=class_densities,
            class_avoid=class_avoid,
        )
        if count is not None and len(kept) >= count:
            raise e.invalid(f"count is {count}, but {len(kept)} existing samples count too")
        part = 1.0 if radii is None else radii.distance_part
        self._params = params = s.SurfaceParams(
            min_distance=0.0 if distance is None else distance / part,
            seed=seed,
            pool_ratio=float(pool_ratio),
            darts=darts,
            stop_count=stop_count,
            radii=None if radii is None else radii.handle.value,
            face_keys=None if keys is None else keys.ctypes.data,
            face_mask=None if mask is None else mask.ctypes.data,
            metric=s.METRICS[metric],
            existing=kept.ctypes.data,
            existing_count=len(kept),
            avoid=places.points.ctypes.data,
            avoid_radii=places.radii.ctypes.data,
            avoid_count=len(places.points),
            is_maximal=int(maximal),
        )
        own_classes = None
        if kinds is not None and kinds.count > 1:
            own_classes = kinds.existing_of(existing, len(kept))
            params.class_factors = kinds.factors.ctypes.data
            params.class_count = kinds.count
            params.existing_classes = own_classes.ctypes.data
            if places.shares is not None:
                params.class_shares = places.shares.ctypes.data
            if places.avoid_classes is not None:
                params.avoid_classes = places.avoid_classes.ctypes.data
        #: As the library takes it.
        self.request = s.Request(
            params=addressof(params),
            count=0.0 if count is None else count,
            is_exact=int(exact),
            order=s.ORDERS["dart" if in_levels is None else "progressive"],
            features=degrees,
            at_vertices=int(at_vertices),
        )
        self._class_counts = None
        if class_counts is not None:
            if own_classes is None or kinds is None:
                raise e.invalid("class_counts is for classes, two or more")
            self._class_counts = kinds.counts_of(class_counts)
            self.request.class_counts = self._class_counts.ctypes.data
        if in_levels is not None:
            self.request.levels, self.request.level_factor = in_levels.count, in_levels.factor

        self._kept_alive = radii, keys, kept, places, own_classes
        self._distance, self._part, self._seed, self._mask = distance, part, seed, mask
        self._count, self._stop_count, self._darts = count, stop_count, darts
        self._existing, self._avoids, self._classes = len(kept), len(places.points) > 0, kinds
        self._is_farthest, self._degrees = order == "farthest", degrees
        self._told = joins_of(
            mesh._surface.weld, mesh._surface.keep_seams, mesh._surface.walls
        )
        if metric != "geodesic":
            self._told["metric"] = metric
        if pool_ratio != 20:
            self._told["pool_ratio"] = exact_text(pool_ratio)
        if features is not None:
            self._told["features"] = exact_text(degrees)
        if at_vertices:
            self._told["at_vertices"] = "yes"
        self._job = Job(
            None,
            pool_ratio,
            density,
            radius_factor,
            face_keys,
            face_mask,
            existing,
            avoid,
            mesh._source,
        )

    def samples_of(
        self, made: c.Handle, device: DeviceLike | None, progress: bool | ProgressCallback
    ) -> Samples:
        """Returns the samples that were made, in the order asked for."""
        report = report_of(made)
        run_distance, told = report["min_distance"], dict(self._told)
        if self._darts:
            told["darts"] = str(report["candidates"])
        if self._params.is_maximal:
            told["maximal"] = "certified" if report["is_certified"] else "not certified"
        if report["cut"] and self._class_counts is None:
            told["exact"] = str(report["samples"])
        samples = samples_of(
            made,
            self._seed,
            self.mesh._surface,
            given=self._distance,
            distance_part=self._part,
            classes=self._classes,
            _job=dataclasses.replace(self._job, distance=run_distance),
            _told=told,
            _frame=self._frame_at(run_distance),
        )
        samples.report["options"] = self._options
        if self.request.at_vertices:
            samples.columns["vertex"] = vertices_at(samples, self.mesh._surface)
        if self._is_farthest:
            samples = put_farthest_first(
                self.mesh._handle, samples, self._existing, device, progress
            )
        return samples

    def _frame_at(self, run_distance: float) -> JobFrame | None:
        """Returns the frame of a run whose distance samples say rounded, else None."""
        told = run_distance * self._part if self._distance is None else self._distance
        if told / self._part == run_distance:
            return None
        params = s.SurfaceParams.from_buffer_copy(self._params)
        params.min_distance, params.existing_count, params.stop_count = run_distance, 0, 0
        return JobFrame.found("geodisk_job_frame_of", self.mesh._handle.value, byref(params))

    def warn(self, samples: Samples, prefix: str = "") -> None:
        """Shows warnings about the samples that were made."""
        found = oddities_of_set(
            samples,
            self.mesh._handle,
            self._count,
            self._stop_count,
            self._darts,
            self._mask,
            self._existing,
            self._avoids,
            self._degrees if samples.report["lacks_features"] else 0,
        )
        warn([e.GeodiskWarning(f"{prefix}{one}", one.kind, one.count) for one in found])
        if self._classes is not None and self._classes.count > 1 and len(samples) > 0:
            made = np.bincount(samples.columns["class"], minlength=self._classes.count)
            for number in np.flatnonzero(made == 0):
                text = f"{prefix}class {number} has no sample"
                warn([e.GeodiskWarning(text, "empty_class", 1)])
        if self._class_counts is not None:
            made = np.bincount(samples.columns["class"], minlength=len(self._class_counts))
            for number in np.flatnonzero(made < self._class_counts):
                text = f"class {number} has {made[number]} of {self._class_counts[number]} samples"
                warn([e.GeodiskWarning(f"{prefix}{text}", "few_of_class", int(made[number]))])


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


_ARGUMENTS = inspect.signature(Wanted).parameters.keys() - {"read_mesh"}
_OF_MESH = ("edge_lengths", "weld", "keep_seams", "columns", "mesh_format", "allow_outside")


def wanted_of(vertices: Any, faces: Any, record: Record, given: Mapping[str, Any]) -> Wanted:
    """Returns what arguments of :func:`sample` ask for, by name, on a mesh that is read for `record`."""

    def read_mesh() -> Mesh:
        named = (given["density"], given["radius_factor"], *values_of(given["class_densities"]))
        return mesh_of(
            vertices,
            faces,
            **{name: given[name] for name in _OF_MESH},
            attributes=attributes_with(given["attributes"], vertices, *named),
            record=record,
        )

    return Wanted(read_mesh, **{name: given[name] for name in _ARGUMENTS})
