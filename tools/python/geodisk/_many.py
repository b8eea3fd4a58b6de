"""Sampling many meshes together."""

from __future__ import annotations

import os
import reprlib
from collections.abc import Sequence
from typing import Any, Iterable, Mapping

import numpy as np
from numpy.typing import ArrayLike

from . import _errors as e
from ._classes import ClassesLike
from ._devices import DeviceLike
from ._existing import AvoidLike, ExistingLike
from ._protocols import MeshLike
from ._record import Record, recorded
from ._running import ProgressCallback, Runs
from ._samples import Samples
from ._values import listed
from ._wanted import Wanted, wanted_of


#: Parameters that have an array for each mesh.
_ARRAYS = (
    *("density", "radius_factor", "face_keys", "face_mask", "existing", "avoid"),
    *("class_masks", "class_densities", "class_avoid"),
)


def sample_many(
    meshes: Iterable[MeshLike | tuple[ArrayLike, Any]],
    *,
    min_distance: float | Sequence[float] | None = None,
    radius: float | Sequence[float] | None = None,
    count: float | Sequence[float] | None = None,
    exact: bool = False,
    seed: int | None | Sequence[int | None] = 0,
    density: Sequence[ArrayLike | None] | None = None,
    radius_factor: Sequence[ArrayLike | None] | None = None,
    face_keys: Sequence[ArrayLike | None] | None = None,
    face_mask: Sequence[ArrayLike | None] | None = None,
    existing: Sequence[ExistingLike | None] | None = None,
    avoid: Sequence[AvoidLike | None] | None = None,
    pool_ratio: float = 20,
    darts: int = 0,
    stop_count: int = 0,
    maximal: bool = False,
    order: str = "dart",
    levels: int | None = None,
    level_factor: float | None = None,
    classes: ClassesLike | None = None,
    class_counts: Sequence[int] | None = None,
    class_masks: Sequence[Mapping[int, ArrayLike] | None] | None = None,
    class_densities: Sequence[Mapping[int, ArrayLike] | None] | None = None,
    class_avoid: Sequence[Mapping[int, AvoidLike] | None] | None = None,
    features: float | None = None,
    at_vertices: bool = False,
    metric: str = "geodesic",
    weld: bool | float = False,
    keep_seams: bool = False,
    columns: str | Sequence[str] = (),
    attributes: str | Sequence[str] = (),
    texture: str | os.PathLike[str] | None = None,
    normals: str = "face",
    frames: bool | float | str = False,
    up: str | None = None,
    mesh_format: str | None = None,
    allow_outside: bool = False,
    device: DeviceLike | None = None,
    progress: bool | ProgressCallback = False,
) -> list[Samples]:
    """Samples several meshes together, which is faster than sampling them separately.

    Each mesh gets the same samples as from :func:`sample`. Their runs share jobs, as far as every
    device has room for. Runs with `darts`, `stop_count`, `maximal`, `classes`, and metrics other
    than geodesic are jobs of their own.

    Parameters
    ----------
    meshes : iterable of meshes
        Each is a :class:`Mesh`, a path, an object of another package, or a pair of vertices and
        faces, as for :func:`sample`. A :class:`Mesh` may appear several times.
    min_distance, radius, count, seed : number, or a sequence with one per mesh
        As for :func:`sample`.
    density, radius_factor, face_keys, face_mask, existing, avoid, class_masks, class_densities,
    class_avoid : sequence of one per mesh, or None
        As for :func:`sample`; None for a mesh without.
    exact, pool_ratio, darts, stop_count, maximal, order, levels, level_factor, classes,
    class_counts, features, at_vertices, metric, weld, keep_seams, columns, attributes, texture, normals, frames,
    up, mesh_format, allow_outside, device, progress
        As for :func:`sample`, for all meshes.

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
    given = dict(locals(), edge_lengths=None)
    record = Record(texture, normals, frames, up)
    all_meshes = listed(meshes)
    if all_meshes is None:
        raise TypeError(f"meshes is {reprlib.repr(meshes)}, not a list of meshes")
    several, n = all_meshes, len(all_meshes)
    own = {name: _each(given[name], name, n) for name in ("min_distance", "radius", "count", "seed")}
    own |= {name: _each_array(given[name], name, n) for name in _ARRAYS}

    def wanted_at(i: int) -> Wanted:
        return wanted_of(*_parts_of(several[i]), record, given | {name: x[i] for name, x in own.items()})

    wanted = [_named(i, wanted_at) for i in range(n)]
    if not wanted:
        return []
    with Runs(device, progress) as runs:
        requests = [(one.mesh._handle, one.request) for one in wanted]
        made = runs.serve(requests) if n > 1 else _named(0, lambda _: runs.serve(requests))
    results = []
    for i, one in enumerate(wanted):
        samples = _named(i, lambda i: wanted[i].samples_of(made[i], device, progress))
        one.warn(samples, f"mesh {i}: ")
        results.append(recorded(samples, one.mesh, record))
    return results


def _named(index: int, make: Any) -> Any:
    """Returns `make(index)`; errors name the mesh."""
    try:
        return make(index)
    except e.Error as error:
        message = f"mesh {index}: {error}"
        raise type(error)(message, error.status, error.element) from error
    except (TypeError, OSError) as error:
        raise type(error)(f"mesh {index}: {error}") from error


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
