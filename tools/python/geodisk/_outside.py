"""Faces that are seen from outside."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from . import _library as c
from ._mesh import mesh_of
from ._running import ProgressCallback
from ._searching import listened
from ._protocols import Faces, MeshLike
from ._values import number


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
    mesh = mesh_of(
        vertices, faces, None, False, mesh_format=mesh_format, allow_outside=allow_outside
    )
    share = number(share, "share")
    if not 0 <= share <= 1:
        raise e.invalid(f"share is {share}, not from 0 to 1")
    mask = np.empty(mesh._info.faces, np.uint8)
    listened(
        progress,
        lambda hear: c.call(
            "geodisk_outside_faces", mesh._handle.value, share, hear, None, mask.ctypes.data
        ),
    )
    return mask.view(np.bool_)
