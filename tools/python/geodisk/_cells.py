"""The geodesic Voronoi cells of samples."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _library as c
from . import _structs as s
from ._devices import DeviceLike, name_of
from ._existing import ExistingLike, points_of
from ._mesh import Mesh, mask_of, mesh_of
from ._protocols import MeshLike
from ._running import ProgressCallback
from ._searching import search
from ._source import view_of
from ._values import flag, integer


@dataclass(frozen=True, eq=False)
class Cells:
    """The geodesic Voronoi cells of samples: what is nearer to each than to all others.

    Attributes
    ----------
    area : ndarray of float64, shape (n,)
        Area of the cell of each sample. They sum to the area of the mesh, or of the faces of the mask,
        without `unreached`.
    edges : ndarray of uint32, shape (e, 2)
        Pairs of samples whose cells touch along a line, the lower sample first.
    triangles : ndarray of uint32, shape (t, 3)
        Samples whose cells meet at a point: the faces of a mesh whose vertices are the samples.
    area_error : float
        No area is off by more. What is equally near to several samples counts as well.
    error : float
        Distances are at most so far from exact ones on the mesh.
    unreached : float
        Area of the parts of the mesh without a sample.
    manifold_triangles : int
        Triangles whose edges have one or two triangles, and whose corners have one fan of them.
    euler, mesh_euler : int
        Vertices - edges + triangles of the dual graph, and of the mesh.
    """

    area: NDArray[np.float64]
    edges: NDArray[np.uint32]
    triangles: NDArray[np.uint32]
    area_error: float
    error: float
    unreached: float
    manifold_triangles: int
    euler: int
    mesh_euler: int

    def __len__(self) -> int:
        return len(self.area)

    def __repr__(self) -> str:
        return f"<geodisk.Cells of {len(self)} samples, {len(self.triangles)} triangles>"


def cells(
    mesh: Mesh | MeshLike,
    samples: ExistingLike,
    *,
    dual: bool = True,
    face_mask: ArrayLike | None = None,
    max_records: int = 2**27,
    device: DeviceLike | None = None,
    progress: bool | ProgressCallback = False,
) -> Cells:
    """Returns the geodesic Voronoi cells of samples: their areas, and which of them meet.

    Parameters
    ----------
    mesh : Mesh, path, or a mesh of another package
        The mesh that the samples lie on.
    samples : Samples, or a pair of face_index and barycentric
        At least one; also points of other programs, as for :func:`verify`. Of samples in the same
        place the first has the cell.
    dual : bool
        Find edges and triangles too.
    face_mask : array_like of bool, shape (f,), or of int, optional
        Faces whose areas count, and where cells touch; as for :func:`sample`. Distances still cross
        the others.
    max_records : int
        Fail if the disks of the samples have more records of paths, 36 bytes each.
    device, progress
        As for :func:`sample`; a callback is called on another thread.

    Returns
    -------
    Cells

    Raises
    ------
    InvalidArgument, TypeError
        For values out of range, and arrays of a wrong type or shape.
    OutOfMemory
        For more than `max_records`.
    Others as :func:`sample`.

    Examples
    --------
    >>> import geodisk
    >>> square = geodisk.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    >>> halves = geodisk.cells(square, ([0, 1], [[1, 0, 0], [0, 1, 0]]))
    >>> halves.area.round(3).tolist()
    [0.5, 0.5]
    >>> halves.edges.tolist()
    [[0, 1]]
    """
    on = mesh_of(mesh)
    points = points_of(on._handle, samples, "samples", is_needed=True)
    mask = None if face_mask is None else mask_of(on._surface, face_mask)
    params = s.CellParams(
        samples=points,
        sample_count=len(points),
        areas_only=int(not flag(dual, "dual")),
        max_records=integer(max_records, "max_records", 2**64 - 1, 1),
        face_mask=mask,
    )
    handle = search("cells", "geodisk_find_cells", on._handle, params, name_of(device), progress)
    told = c.filled(s.CellArrays, "geodisk_cells_describe", handle)
    return Cells(
        view_of(told.areas, (told.sample_count,), handle, np.float64),
        view_of(told.edges, (told.edge_count, 2), handle),
        view_of(told.triangles, (told.triangle_count, 3), handle),
        told.area_error,
        told.distance_error,
        told.unreached,
        told.manifold_triangles,
        told.euler,
        told.mesh_euler,
    )
