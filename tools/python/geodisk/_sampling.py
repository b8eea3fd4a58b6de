"""Sampling meshes and boxes."""

from __future__ import annotations

import ctypes
import math
import operator
from ctypes import byref, c_double, c_int32
from typing import Any, Callable

import numpy as np
from numpy.typing import ArrayLike

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._devices import forget, sampler_on
from ._mesh import keys_of, mesh_of, radii_of
from ._protocols import MeshLike
from ._samples import Samples, samples_of

_PATIENCE = 100  # Milliseconds, after which Python looks for signals.

#: Called with a number from 0 to 1, how far the run is, and with how many samples there are.
ProgressCallback = Callable[[float, int], None]


def _integer(value: Any, name: str, most: int) -> int:
    number = operator.index(value)
    if not 0 <= number <= most:
        raise e.invalid(f"{name} is {number}, not from 0 to {most}")
    return number


def _distance(
    min_distance: float | None, radius: float | None, count: float | None
) -> float | None:
    """The minimum distance, or None where a count chooses it."""
    given = [x is not None for x in (min_distance, radius, count)]
    if sum(given) != 1:
        raise e.invalid("give one of min_distance, radius and count")
    if min_distance is not None:
        distance = float(min_distance)
    elif radius is not None:
        distance = 2 * float(radius)
    else:
        return None
    if not (distance > 0 and math.isfinite(distance)):
        raise e.invalid(f"the minimum distance is {distance}, not positive")
    return distance


class _Bar:
    """Progress by tqdm."""

    def __init__(self) -> None:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            raise ImportError("progress=True needs tqdm (pip install tqdm)") from None
        self._bar = tqdm(total=100, unit="%", desc="geodisk", leave=False)

    def __call__(self, part: float, samples: int) -> None:
        self._bar.n = round(100 * part, 1)
        self._bar.set_postfix(samples=samples)

    def close(self) -> None:
        self._bar.close()


def _polled(
    sampler: ctypes.c_void_p, samples: c.Handle, tell: ProgressCallback | None
) -> None:
    """Goes on with a run until its samples are there. Python acts on signals in between."""
    progress = s.Progress()
    while not samples.value:
        c.call("geodisk_poll", sampler, _PATIENCE, byref(samples.value))
        if tell and not samples.value:
            c.call("geodisk_sampler_progress", sampler, byref(progress))
            tell(progress.decided / max(1, progress.candidates), progress.accepted)


def _end(sampler: ctypes.c_void_p) -> None:
    """Stops the run in progress, if there is one."""
    rest = c.Handle("samples")
    c.cancel(sampler)
    try:
        while not rest.value:
            c.call("geodisk_poll", sampler, _PATIENCE, byref(rest.value))
    except e.Error:  # Cancelled; or it had ended.
        pass


def _run(domain: c.Handle, device: str, tell: ProgressCallback | None) -> c.Handle:
    sampler = sampler_on(device).value
    samples = c.Handle("samples")
    try:
        c.call("geodisk_start", sampler, domain.value)
        _polled(sampler, samples, tell)
        return samples
    except e.DeviceLost:
        forget(device)
        raise
    except e.Error:
        raise
    except BaseException:  # Ctrl-C, or what a callback raises.
        _end(sampler)
        raise


def _sampled(
    domain_at: Callable[[float], c.Handle],
    first: float,
    count: float | None,
    device: str | int | None,
    progress: bool | ProgressCallback,
) -> c.Handle:
    """Samples at the first distance, or the one that a search for the count ends with."""
    tell = progress if callable(progress) else _Bar() if progress else None
    device = "" if device is None else str(device)
    try:
        if count is None:
            return _run(domain_at(first), device, tell)
        search = c.Handle("count_search", "geodisk_count_search_create", float(count))
        distance, best = c_double(first), c.Handle("samples")
        while distance.value > 0:
            found = _run(domain_at(distance.value), device, tell)
            nearest = c_int32()
            c.call(
                "geodisk_count_search_note",
                search.value,
                distance.value,
                c.samples_count(found.value),
                byref(distance),
                byref(nearest),
            )
            best = found if nearest.value else best
        return best
    finally:
        if isinstance(tell, _Bar):
            tell.close()


def sample(
    vertices: ArrayLike | MeshLike,
    faces: ArrayLike | None = None,
    *,
    min_distance: float | None = None,
    radius: float | None = None,
    count: float | None = None,
    seed: int = 0,
    density: ArrayLike | None = None,
    pool_ratio: float = 20,
    throws: int = 0,
    stop_count: int = 0,
    face_keys: ArrayLike | None = None,
    metric: str = "geodesic",
    edge_lengths: ArrayLike | None = None,
    weld: bool | float = False,
    device: str | int | None = None,
    progress: bool | ProgressCallback = False,
) -> Samples:
    """Random points on a mesh, no two closer than a minimum distance along the surface.

    Parameters
    ----------
    vertices : array_like of float, shape (v, d), or a mesh
        Coordinates; or a :class:`Mesh`, a ``trimesh.Trimesh``, an Open3D mesh or a path.
    faces : array_like of int, shape (f, 3)
    min_distance, radius, count : float
        One of them: the least distance along the surface in the unit of the vertices, half of it,
        or about how many samples there are to be, for which a distance is found.
    seed : int
        Of 64 bits. Equal seeds give equal samples, on every device.
    density : array_like of float, shape (v,), optional
        Radii that vary: at each vertex the part of the largest radius, 0.001 to 1.
    pool_ratio : float
        Candidates per expected sample, 1 to 10,000; more leave fewer gaps.
    throws : int
        So many darts instead of candidates by `pool_ratio`.
    stop_count : int
        Just the first so many samples.
    face_keys : array_like of int, shape (f,), optional
        By which candidates of each face are drawn, no two alike: the same triangle with the same
        key has the same candidates in every mesh.
    metric : {"geodesic", "euclidean", "approximate"}
        The latter two are for comparison.
    edge_lengths, weld
        As :class:`Mesh` has them.
    device : str or int, optional
        A part of its name, its index or its UUID; the best one if not given.
    progress : bool or callable
        True for a bar by tqdm; or what is called with the part done and the samples so far.

    Returns
    -------
    Samples

    Raises
    ------
    MeshRejected
        Where the mesh cannot be sampled; ``element`` is the face or vertex.
    InvalidArgument, TypeError
        For values out of range, and arrays of another kind or shape.
    NoDevice, OutOfMemory, DeviceLost
        As the device fails.
    KeyboardInterrupt
        Ctrl-C ends a run at once.

    Examples
    --------
    >>> import geodisk
    >>> corners = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]
    >>> tetrahedron = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]
    >>> samples = geodisk.sample(corners, tetrahedron, min_distance=0.2, seed=7)
    >>> samples.points.shape
    (213, 3)
    >>> bool(samples.face_index.max() < 4)
    True
    """
    distance = _distance(min_distance, radius, count)
    seed = _integer(seed, "seed", 2**64 - 1)
    if metric not in s.METRICS:
        raise e.invalid(f"metric is {metric!r}, none of {', '.join(s.METRICS)}")
    mesh = mesh_of(vertices, faces, edge_lengths, weld)
    radii = None if density is None else radii_of(mesh, density)
    keys = None if face_keys is None else keys_of(mesh, face_keys)
    params = s.SurfaceParams(
        seed=seed,
        pool_ratio=float(pool_ratio),
        throws=_integer(throws, "throws", 2**32 - 1),
        stop_count=_integer(stop_count, "stop_count", 2**32 - 1),
        radii=None if radii is None else radii.value,
        face_keys=None if keys is None else keys.ctypes.data,
        metric=s.METRICS[metric],
    )

    def domain_at(at: float) -> c.Handle:
        params.min_distance = at
        return c.Handle("domain", "geodisk_domain_surface", mesh._handle.value, byref(params))

    if distance is None:
        found = c_double()
        c.call(
            "geodisk_distance_for_count",
            mesh._handle.value,
            None if radii is None else radii.value,
            float(count or 0),
            byref(found),
        )
        distance = found.value
    made = _sampled(domain_at, distance, count, device, progress)
    return samples_of(made, seed, _surface=mesh._surface)


def sample_box(
    extents: ArrayLike = (1, 1),
    *,
    periodic: bool = False,
    min_distance: float | None = None,
    radius: float | None = None,
    count: float | None = None,
    seed: int = 0,
    pool_ratio: float = 20,
    throws: int = 0,
    stop_count: int = 0,
    device: str | int | None = None,
    progress: bool | ProgressCallback = False,
) -> Samples:
    """Random points in a box, no two closer than a minimum distance.

    Parameters
    ----------
    extents : sequence of float
        One to six sides; the box begins at the origin.
    periodic : bool
        Opposite sides are glued together: distances go around.

    The other parameters, the result and the errors are those of :func:`sample`; `face_index`,
    `barycentric` and `normals` of the result are None.

    Examples
    --------
    >>> import geodisk
    >>> samples = geodisk.sample_box([1, 1, 1], count=500, periodic=True)
    >>> samples.points.shape[1]
    3
    """
    distance = _distance(min_distance, radius, count)
    sides = np.ascontiguousarray(extents, dtype=np.float64)
    if sides.ndim != 1:
        raise e.invalid("extents are one number for each dimension")
    seed = _integer(seed, "seed", 2**64 - 1)
    params = s.BoxParams(
        extents=sides.ctypes.data_as(ctypes.POINTER(c_double)),
        dimension=len(sides),
        is_periodic=int(bool(periodic)),
        seed=seed,
        pool_ratio=float(pool_ratio),
        throws=_integer(throws, "throws", 2**32 - 1),
        stop_count=_integer(stop_count, "stop_count", 2**32 - 1),
    )

    def domain_at(at: float) -> c.Handle:
        params.min_distance = at
        return c.Handle("domain", "geodisk_domain_box", byref(params))

    if distance is None:
        found = c_double()
        c.call("geodisk_box_distance_for_count", byref(params), float(count or 0), byref(found))
        distance = found.value
    made = _sampled(domain_at, distance, count, device, progress)
    return samples_of(made, seed, extents=tuple(sides.tolist()), periodic=bool(periodic))
