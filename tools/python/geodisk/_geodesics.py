"""What the CPU finds on a surface: exact distances, shortest paths, and faces seen from outside."""

from __future__ import annotations

from ctypes import byref, c_size_t, sizeof, string_at
from dataclasses import dataclass
from typing import Any, Literal, Tuple, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._arrays import array_of
from ._background import interruptible
from ._existing import ExistingLike, points_of
from ._mesh import Mesh, is_mesh, mesh_of
from ._neighbours import SourcesLike, set_sources
from ._protocols import Faces, MeshLike
from ._running import ProgressCallback
from ._samples import Sample
from ._searching import listened
from ._values import flag, integer, number

#: A vertex by its index, coordinates, one sample, or a triangle and weights.
EndLike = Union[int, ArrayLike, Sample, Tuple[int, ArrayLike]]


@dataclass(frozen=True, eq=False)
class GeodesicPath:
    """A shortest path along a surface.

    Attributes
    ----------
    points : ndarray of float64, shape (n, d), or None
        Its two ends, and between them where it crosses an edge or bends at a vertex. It runs
        straight from each to the next. None for a surface of edge lengths alone.
    length : float
    face_index : ndarray of uint32, shape (n,)
    barycentric : ndarray of float64, shape (n, 3)
        Where the points are on the mesh's triangles.
    """

    points: NDArray[np.float64] | None
    length: float
    face_index: NDArray[np.uint32]
    barycentric: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.face_index)

    def __repr__(self) -> str:
        return f"<geodisk.GeodesicPath of {len(self)} points, length {self.length:.6g}>"


@overload
def geodesic_distances(
    vertices: ArrayLike | MeshLike,
    faces: Faces | None = None,
    sources: SourcesLike | None = None,
    *,
    targets: ExistingLike | None = None,
    each: bool = False,
    return_nearest: Literal[False] = False,
    within: float | None = None,
    edge_lengths: ArrayLike | None = None,
    weld: bool | float = False,
    keep_seams: bool = False,
    mesh_format: str | None = None,
    allow_outside: bool = False,
    progress: bool | ProgressCallback = False,
) -> NDArray[np.float64]: ...


@overload
def geodesic_distances(
    vertices: ArrayLike | MeshLike,
    faces: Faces | None = None,
    sources: SourcesLike | None = None,
    *,
    targets: ExistingLike | None = None,
    each: bool = False,
    return_nearest: Literal[True],
    within: float | None = None,
    edge_lengths: ArrayLike | None = None,
    weld: bool | float = False,
    keep_seams: bool = False,
    mesh_format: str | None = None,
    allow_outside: bool = False,
    progress: bool | ProgressCallback = False,
) -> tuple[NDArray[np.float64], NDArray[np.int64]]: ...


def geodesic_distances(
    vertices: ArrayLike | MeshLike,
    faces: Faces | None = None,
    sources: SourcesLike | None = None,
    *,
    targets: ExistingLike | None = None,
    each: bool = False,
    return_nearest: bool = False,
    within: float | None = None,
    edge_lengths: ArrayLike | None = None,
    weld: bool | float = False,
    keep_seams: bool = False,
    mesh_format: str | None = None,
    allow_outside: bool = False,
    progress: bool | ProgressCallback = False,
) -> NDArray[np.float64] | tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Returns the distances of all vertices from sources, along the surface.

    They are exact up to the rounding of double precision, and computed on the CPU, each source by
    one thread. No device is needed.

    Parameters
    ----------
    vertices, faces, edge_lengths, weld, keep_seams, mesh_format, allow_outside
        The mesh, as for :class:`Mesh`. After a :class:`Mesh` or a file, sources may come second:
        ``geodesic_distances(mesh, 0)``.
    sources : int, array_like of int or bool, Samples, coordinates, or faces and weights
        Vertices or points, as for :func:`neighbours`; or one vertex.
    targets : Samples, coordinates, or faces and weights, optional
        Points to measure to, instead of all vertices.
    each : bool
        Return a row of distances for each source, instead of those from the nearest one.
    return_nearest : bool
        Also return the index of the nearest source of each target, -1 where there is none. Not
        with `each`.
    within : float, optional
        Farther targets get infinity, which saves time.
    progress : bool or callable
        As for :func:`sample`. A callback is called on other threads.

    Returns
    -------
    distances : ndarray of float64, shape (v,), with `each` (n, v)
        Infinity where no path leads.
    nearest : ndarray of int64, shape (v,)
        Only with `return_nearest`.

    Raises
    ------
    InvalidArgument, TypeError
        For values out of range, and arrays of a wrong type or shape.
    MeshRejected
        For a mesh with so many edges of more than two faces that the search would not end.
    Cancelled
        If `progress` returned False.

    Examples
    --------
    >>> import geodisk
    >>> square = geodisk.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    >>> geodisk.geodesic_distances(square, 0).round(4).tolist()
    [0.0, 1.0, 1.4142, 1.0]
    """
    mesh, after = _mesh_and_after(
        vertices, faces, edge_lengths=edge_lengths, weld=weld, keep_seams=keep_seams,
        mesh_format=mesh_format, allow_outside=allow_outside,
    )
    if after is not None and sources is not None:
        raise TypeError("a mesh and sources are given, and sources again")
    sources = after if sources is None else sources
    if sources is None:
        raise e.invalid("give sources: from where to measure")
    each, return_nearest = flag(each, "each"), flag(return_nearest, "return_nearest")
    if each and return_nearest:
        raise e.invalid("each and return_nearest exclude each other: each source has a row")
    params = _query(mesh, sources)
    params.each = int(each)
    if within is not None:
        params.within = number(within, "within")
        if not params.within > 0:
            raise e.invalid(f"within is {within}, which is not positive")
    width = mesh._surface.vertex_count()
    if targets is not None:
        points = points_of(mesh._handle, targets, "targets")
        params.targets, params.target_count = points, len(points)
        width = len(points)
    distances = np.empty((params.source_count, width) if each else width, np.float64)
    nearest = np.empty(width, np.uint32)
    listened(
        progress,
        lambda hear: c.call(
            "geodisk_geodesic_distances", mesh._handle, params, hear, None, distances,
            None if each else nearest,
        ),
    )
    if not return_nearest:
        return distances
    return distances, np.where(nearest == 2**32 - 1, -1, nearest.astype(np.int64))


def disk_radii(
    vertices: ArrayLike | MeshLike,
    faces: Faces | Any | None = None,
    sources: Any = None,
    area: float | None = None,
    *,
    edge_lengths: ArrayLike | None = None,
    weld: bool | float = False,
    keep_seams: bool = False,
    mesh_format: str | None = None,
    allow_outside: bool = False,
    progress: bool | ProgressCallback = False,
) -> NDArray[np.float64]:
    """Returns the radius of the disk around each source that holds an area, along the surface.

    Parameters
    ----------
    vertices, faces, edge_lengths, weld, keep_seams, mesh_format, allow_outside
        The mesh, as for :class:`Mesh`. After a :class:`Mesh` or a file, `sources` and `area` may come second
        and third: ``disk_radii(mesh, 0, 0.1)``.
    sources : int, array_like of int or bool, Samples, coordinates, or faces and weights
        As for :func:`geodesic_distances`.
    area : float
        In square units of the mesh. A disk that would be larger than its part of the mesh covers
        that part.
    progress
        As for :func:`sample`; counts sources.

    Returns
    -------
    ndarray of float64, shape (n,)
        For ``within`` of :func:`neighbours`. Areas err by about 1 in 1,000.

    Raises
    ------
    InvalidArgument, TypeError
        For an area that is not positive, and sources that are not on the mesh.

    Examples
    --------
    >>> import geodisk
    >>> square = geodisk.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    >>> geodisk.disk_radii(square, 0, area=0.1).round(2).tolist()  # A quarter of a circle.
    [0.36]
    """
    mesh, after = _mesh_and_after(
        vertices, faces, edge_lengths=edge_lengths, weld=weld, keep_seams=keep_seams,
        mesh_format=mesh_format, allow_outside=allow_outside,
    )
    if after is not None:  # As in (mesh, sources, area).
        if sources is not None and area is not None:
            raise TypeError("a mesh, sources and an area are given, and sources again")
        area = sources if area is None else area
        sources = after
    if sources is None or area is None:
        raise e.invalid("give sources and area: from where, and how much the disks hold")
    area = number(area, "area")
    if not 0 < area < np.inf:
        raise e.invalid(f"area is {area}, not positive and finite")
    params = _query(mesh, sources)
    radii = np.empty(params.source_count, np.float64)
    listened(
        progress,
        lambda hear: c.call(
            "geodisk_disk_radii", mesh._handle, params, area, hear, None, radii
        ),
    )
    return radii


def geodesic_path(
    vertices: ArrayLike | MeshLike,
    faces: Faces | EndLike | None = None,
    start: EndLike | None = None,
    end: EndLike | None = None,
    *,
    edge_lengths: ArrayLike | None = None,
    weld: bool | float = False,
    keep_seams: bool = False,
    mesh_format: str | None = None,
    allow_outside: bool = False,
) -> GeodesicPath:
    """Returns a shortest path along the surface from one point to another.

    Parameters
    ----------
    vertices, faces, edge_lengths, weld, keep_seams, mesh_format, allow_outside
        The mesh, as for :class:`Mesh`. After a :class:`Mesh` or a file, the ends may come second
        and third: ``geodesic_path(mesh, 0, 5)``.
    start, end : int, coordinates, Sample, or a pair of face and weights
        A vertex by its index, or a point: its coordinates, one sample, or a triangle's index and
        the weights of its corners.

    Returns
    -------
    GeodesicPath

    Raises
    ------
    InvalidArgument, TypeError
        For an end that is not on the mesh, and if no path leads from one to the other.
    MeshRejected
        As for :func:`geodesic_distances`.

    Examples
    --------
    >>> import geodisk
    >>> square = geodisk.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    >>> path = geodisk.geodesic_path(square, 1, 3)
    >>> round(path.length, 4), path.points.round(4).tolist()
    (1.4142, [[1.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.0, 1.0, 0.0]])
    """
    mesh, after = _mesh_and_after(
        vertices, faces, edge_lengths=edge_lengths, weld=weld, keep_seams=keep_seams,
        mesh_format=mesh_format, allow_outside=allow_outside,
    )
    if after is not None:  # As in (mesh, start, end).
        if end is not None:
            raise TypeError("a mesh and two ends are given, and a third one")
        start, end = after, start
    if start is None or end is None:
        raise e.invalid("give start and end: the two ends of the path")
    params = s.PathParams()
    _set_end(params, mesh, start, "start", "from")
    _set_end(params, mesh, end, "end", "to")
    path = interruptible(
        lambda stop: c.Handle("path", "geodisk_geodesic_path", mesh._handle, params)
    )
    count = c_size_t()
    address = c.ask("geodisk_path_points", path, byref(count))
    data = string_at(address, count.value * sizeof(s.PathPoint))
    points = np.frombuffer(data, np.dtype(s.PathPoint))
    faces_of, weights = points["face"].copy(), points["weights"].copy()
    place = None
    if not isinstance(mesh.vertices, int):
        corners = mesh.vertices[mesh.triangles[faces_of]].astype(np.float64)
        place = np.einsum("nk,nkd->nd", weights, corners)
    return GeodesicPath(place, c.ask("geodisk_path_length", path), faces_of, weights)


def outside_faces(
    vertices: ArrayLike | MeshLike,
    faces: Faces | None = None,
    *,
    share: float = 0.02,
    mesh_format: str | None = None,
    allow_outside: bool = False,
    progress: bool | ProgressCallback = False,
) -> NDArray[np.bool_]:
    """Finds the triangles that are seen from outside of a surface.

    Not those of inner shells, nor of the engine in a car. Rays start at four points of each triangle,
    in 64 directions, the same on every machine.

    Parameters
    ----------
    vertices, faces, mesh_format, allow_outside
        The mesh, as for :class:`Mesh`, with three coordinates per vertex.
    share : float
        From 0 to 1. A triangle is seen if this share of the rays on one of its sides, and at least
        one, meets no other triangle.
    progress
        As for :func:`sample`.

    Returns
    -------
    ndarray of bool, shape (f,)
        For ``face_mask`` of :func:`sample`. False also for triangles without area.

    Raises
    ------
    InvalidArgument
        For a share out of range, and other numbers of coordinates.

    Examples
    --------
    >>> import geodisk, numpy as np
    >>> corners = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    >>> faces = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
    >>> nested = np.concatenate([corners, 0.2 * corners]), np.concatenate([faces, faces + 4])
    >>> geodisk.outside_faces(*nested).tolist()
    [True, True, True, True, False, False, False, False]
    """
    mesh = mesh_of(vertices, faces, mesh_format=mesh_format, allow_outside=allow_outside)
    share = number(share, "share")
    if not 0 <= share <= 1:
        raise e.invalid(f"share is {share}, not from 0 to 1")
    mask = np.empty(mesh._info.faces, np.uint8)
    listened(
        progress,
        lambda hear: c.call("geodisk_outside_faces", mesh._handle, share, hear, None, mask),
    )
    return mask.view(np.bool_)


def _query(mesh: Mesh, sources: Any) -> s.DistanceParams:
    """Returns sources of distances as the library takes them."""
    params = s.DistanceParams()
    if isinstance(sources, (int, np.integer)) and not isinstance(sources, bool):
        sources = [integer(sources, "sources", 2**32 - 1)]
    set_sources(params, mesh, sources)
    return params


def _mesh_and_after(vertices: Any, faces: Any, **how: Any) -> tuple[Mesh, Any]:
    """Returns the mesh, and the argument in the place of faces after a whole mesh, or None."""
    if is_mesh(vertices):
        return mesh_of(vertices, **how), faces
    return mesh_of(vertices, faces, **how), None


def _set_end(params: Any, mesh: Mesh, end: Any, name: str, field: str) -> None:
    """Sets an end of a path."""
    if isinstance(end, (int, np.integer)) and not isinstance(end, bool):
        vertex, joined = integer(end, name, 2**32 - 1), mesh._surface.joined
        if joined is not None and vertex < len(joined):
            vertex = int(joined[vertex])
        setattr(params, f"{field}_vertex", vertex)
        return
    if isinstance(end, Sample):
        end = (end.face_index, end.barycentric)
    if isinstance(end, tuple) and len(end) == 2 and np.ndim(end[0]) == 0 and np.ndim(end[1]) == 1:
        point = points_of(mesh._handle, ([end[0]], [end[1]]), name)
    elif np.ndim(end) == 1:
        point = points_of(mesh._handle, array_of(end, name)[None], name)
    else:
        raise TypeError(
            f"{name} is neither a vertex, coordinates, one sample, nor a pair of face and weights"
        )
    setattr(params, field, point)
