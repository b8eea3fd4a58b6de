"""What is near each vertex or point of a mesh, along the surface."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterator, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._arrays import array_of, indices, real
from ._devices import DeviceLike, name_of
from ._existing import ExistingLike, are_points, points_of
from ._mesh import Mesh, mesh_of
from ._protocols import Faces, MeshLike
from ._running import ProgressCallback
from ._samples import Samples
from ._searching import search
from ._source import view_of
from ._values import choice, integer

#: Vertices, by their indices, or points as of ExistingLike.
SourcesLike = Union[ArrayLike, ExistingLike]


@dataclass(frozen=True, eq=False)
class Neighbours:
    """The neighbours of each source, one source after the other (CSR).

    Attributes
    ----------
    sources : ndarray of uint32, shape (n,), or None
        Index of the vertex of each source. None if sources are points.
    offsets : ndarray of uint64, shape (n + 1,)
        Where the neighbours of each source begin, and the end of the last.
    indices : ndarray of uint32, shape (pairs,)
        Index of each neighbour: of its vertex, point or source.
    distances : ndarray of float32, shape (pairs,)
        Geodesic distance of each neighbour; 0 for a vertex or point at the source itself.
    error : float
        Distances are at most so far from exact ones on the mesh.

    Notes
    -----
    ``neighbours[i]`` is the pair of indices and distances of source i.
    ``scipy.sparse.csr_matrix((n.distances, n.indices, n.offsets))`` makes a sparse matrix.
    """

    sources: NDArray[np.uint32] | None
    offsets: NDArray[np.uint64]
    indices: NDArray[np.uint32]
    distances: NDArray[np.float32]
    error: float

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __getitem__(self, source: int) -> tuple[NDArray[np.uint32], NDArray[np.float32]]:
        if not isinstance(source, (int, np.integer)) or isinstance(source, bool):
            raise IndexError("the neighbours of a source are chosen by its index")
        if not -len(self) <= source < len(self):
            raise IndexError(f"source {source} of {len(self)}")
        row = int(source) % len(self)
        part = slice(int(self.offsets[row]), int(self.offsets[row + 1]))
        return self.indices[part], self.distances[part]

    def __iter__(self) -> Iterator[tuple[NDArray[np.uint32], NDArray[np.float32]]]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return f"<geodisk.Neighbours of {len(self)} sources, {len(self.indices)} pairs>"


def neighbours(
    vertices: ArrayLike | MeshLike,
    faces: Faces | None = None,
    sources: SourcesLike | None = None,
    *,
    within: float | ArrayLike | None = None,
    among: str | ExistingLike = "vertices",
    nearest: int = 0,
    max_pairs: int = 2**30,
    edge_lengths: ArrayLike | None = None,
    weld: bool | float = False,
    keep_seams: bool = False,
    mesh_format: str | None = None,
    allow_outside: bool = False,
    device: DeviceLike | None = None,
    progress: bool | ProgressCallback = False,
) -> Neighbours:
    """Returns what is within a distance of each source, along the surface, and how far it is.

    Parameters
    ----------
    vertices, faces, edge_lengths, weld, keep_seams, mesh_format, allow_outside
        The mesh, as for :class:`Mesh`.
    sources : array_like of int or bool, Samples, coordinates, or faces and weights, optional
        Vertices by their indices or a mask, or points: Samples, an array of shape (n, d), or a pair
        of face_index and barycentric. By default all vertices that a triangle uses. Points without
        `face_index` are put on the nearest triangles; they must not be farther off the mesh
        than a thousandth of its bounding-box diagonal.
    within : float, or array_like of float, shape (n,), optional
        Distance in units of the mesh: one, or one for each source. Without it, the `nearest` ones
        are found however far they are.
    among : {"vertices", "sources"}, Samples, or a pair of face_index and barycentric
        What to find: vertices of the mesh, the other sources, or points, as for `sources`. Where
        seams are joined, all vertices of a place are found.
    nearest : int
        If not 0, keep only so many of each source: the nearest ones, in the order of their
        distances. Otherwise the neighbours of a source are in the order of their indices.
    max_pairs : int
        Fail as soon as more pairs than this are expected in all.
    device, progress
        As for :func:`sample`; progress counts sources. A callback is called on another thread.

    Returns
    -------
    Neighbours

    Raises
    ------
    InvalidArgument, TypeError
        For values out of range, and arrays of a wrong type or shape.
    OutOfMemory
        For more than `max_pairs`.
    Others as :func:`sample`.

    Examples
    --------
    >>> import geodisk
    >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]]
    >>> near = geodisk.neighbours(*square, within=1.2)
    >>> near[0][0].tolist()
    [0, 1, 3]
    >>> float(near[0][1][1])
    1.0
    """
    mesh = mesh_of(
        vertices, faces, edge_lengths=edge_lengths, weld=weld, keep_seams=keep_seams,
        mesh_format=mesh_format, allow_outside=allow_outside,
    )
    params = s.NeighbourParams(
        nearest=integer(nearest, "nearest", 2**32 - 1),
        max_pairs=integer(max_pairs, "max_pairs", 2**64 - 1, 1),
    )
    count = set_sources(params, mesh, sources)
    _set_within(params, within, count)
    if isinstance(among, str):
        params.kind = s.AMONG[choice(among, "among", s.AMONG)]
    else:
        points = points_of(mesh._handle, among, "among")
        params.kind = s.AMONG_POINTS
        params.points, params.point_count = points, len(points)
    found = search(
        "neighbours", "geodisk_find_neighbours", mesh._handle, params, name_of(device), progress
    )
    return _arrays_of(found)


def set_sources(params: Any, mesh: Mesh, sources: Any) -> int | None:
    """Sets what a search begins from, and which vertices are joined.

    Returns the number of sources, None for all vertices.
    """
    if mesh._surface.joined is not None:
        params.joined = np.ascontiguousarray(mesh._surface.joined, np.uint32)
    if sources is None:
        return None
    is_pair = isinstance(sources, tuple) and len(sources) == 2 and np.ndim(sources[1]) == 2
    if isinstance(sources, Samples) or is_pair or are_points(sources):
        points = points_of(mesh._handle, sources, "sources")
        params.sources, params.source_count = points, len(points)
        return len(points)
    mask = array_of(sources, "sources")
    if mask.dtype == bool:
        if mask.shape != (mesh._surface.vertex_count(),):
            raise e.invalid(
                f"sources is a mask of the shape {mask.shape}, and the mesh has "
                f"{mesh._surface.vertex_count()} vertices"
            )
        sources = np.flatnonzero(mask)
    chosen = indices(sources, "sources").astype(np.uint32)
    if chosen.ndim != 1 or chosen.size == 0:
        raise e.invalid(f"sources have the shape {chosen.shape}, not (n,) with n of at least 1")
    if chosen.size == mesh._surface.vertex_count() > 2 and int(chosen.max()) <= 1:
        raise e.invalid("sources is a mask of zeros and ones; give np.flatnonzero(sources)")
    params.source_vertices, params.source_count = chosen, len(chosen)
    return len(chosen)


def _set_within(
    params: s.NeighbourParams, within: float | ArrayLike | None, count: int | None
) -> None:
    if within is None:
        if params.nearest == 0:
            raise e.invalid("give within, the distance within which neighbours are, or nearest")
        return
    distances = real(within, "within").astype(np.float64)
    wrong = ~((distances > 0) & np.isfinite(distances))
    if wrong.any():
        place = np.argwhere(wrong)[0]
        at = f"[{', '.join(map(str, place))}]" if place.size else ""
        raise e.invalid(
            f"within{at} is {distances[tuple(place)]}, not positive and finite; leave it out to find "
            "the nearest ones however far they are"
        )
    if distances.ndim == 0:
        params.within = float(distances)
        return
    if count is None:
        raise e.invalid("within is an array, so give the sources that it belongs to")
    if distances.shape != (count,):
        raise e.invalid(f"within has the shape {distances.shape}, but there are {count} sources")
    params.radii = np.ascontiguousarray(distances)


def _arrays_of(handle: c.Handle) -> Neighbours:
    """Returns the arrays, which keep the library's object alive."""
    told = c.filled(s.NeighbourArrays, "geodisk_neighbours_describe", handle)
    return Neighbours(
        view_of(told.vertices, (told.source_count,), handle) if told.vertices else None,
        view_of(told.offsets, (told.source_count + 1,), handle, np.uint64),
        view_of(told.indices, (told.pair_count,), handle),
        view_of(told.distances, (told.pair_count,), handle, np.float32),
        told.error,
    )
