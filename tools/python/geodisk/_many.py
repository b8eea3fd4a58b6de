"""Sampling many meshes together."""

from __future__ import annotations

import reprlib
from collections.abc import Sequence
from typing import Any, Callable, Mapping, TypeVar

import numpy as np

from . import _errors as e
from ._record import recorded
from ._running import Runs
from ._samples import Samples
from ._values import listed
from ._wanted import Wanted, record_of, wanted_of

T = TypeVar("T")

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
        return wanted_of(*_parts_of(several[i]), record, alone, _prefix(i))

    wanted = [_named(i, wanted_at) for i in range(n)]
    if not wanted:
        return []
    with Runs(given["device"], given["progress"]) as runs:
        requests = [(one.mesh._handle, one.request) for one in wanted]
        made = runs.serve(requests) if n > 1 else _named(0, lambda _: runs.serve(requests))

    def result_at(i: int) -> Samples:
        samples = wanted[i].samples_of(made[i])
        wanted[i].warn(samples)
        return recorded(samples, wanted[i].mesh, record)

    return [_named(i, result_at) for i in range(n)]


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
