"""Samples on another pose of their mesh."""

from __future__ import annotations

import dataclasses
import os
from typing import Any, Sequence

import numpy as np
from numpy.typing import ArrayLike

from . import _errors as e
from ._inputs import mesh_under, places_of, run
from ._mesh import Mesh, is_mesh, joins_for, mesh_of, posed
from ._protocols import Faces, MeshLike
from ._record import Inherited, Record, recorded
from ._samples import Samples
from ._surface import Surface

_OF_ONE_POSE = frozenset({"cover", "row", "frames"})


def transfer(
    samples: Samples,
    to: ArrayLike | MeshLike,
    vertices: ArrayLike | MeshLike | None = None,
    faces: Faces | None = None,
    *,
    attributes: str | Sequence[str] = (),
    texture: str | os.PathLike[str] | None = None,
    normals: str | None = None,
    frames: bool | float | str | None = None,
    up: str | None = None,
    edge_lengths: ArrayLike | None = None,
    weld: bool | float = False,
    keep_seams: bool = False,
    allow_outside: bool = False,
    tolerance: float | None = None,
) -> Samples:
    """Returns the same samples on another pose of their mesh, with identical faces.

    Parameters
    ----------
    samples : Samples
        Samples on a mesh, or points of other programs as for :func:`verify`.
    to : array_like of float, shape (v, d), or a mesh
        Positions of the vertices, or a mesh with identical faces: also the mesh itself, for its
        attributes.
    attributes : sequence of str, or "all"
        Names of attributes to add, which the file `to` has.
    texture : str or path-like, optional
        PNG, JPEG, WebP, TGA or BMP image whose colours to add, as ``attributes["color"]``, at
        the texture coordinates that the file `to` has. "auto" adds those of the materials of `to`.
    normals : {"face", "file", "smooth"}, optional
        Normals of triangles, those of the file `to`, or interpolated means at vertices. By default
        as the samples have them.
    frames : bool, float or str, optional
    up : {"x", "y", "z"}, optional
        Add ``attributes["frames"]``, as for :func:`sample`. By default as the samples have them.
    vertices, faces, edge_lengths, weld, keep_seams
        Mesh of the samples, as for :func:`sample`. Needed for samples that were read from a file.
    allow_outside : bool
        As for :class:`Mesh`, of the file `to`.
    tolerance : float, optional
        Maximum distance of points of other programs from the mesh, by default a thousandth of the
        bounding-box diagonal.

    Returns
    -------
    Samples
        Samples with the same faces and weights, and their attributes but for ``cover`` and ``row``, which other
        poses change. `min_distance` is their smallest distance there, NaN if no path joins two
        samples, and `radius` is half of it.

    Raises
    ------
    InvalidArgument
        For samples that are not on their mesh, and for different faces.
    MeshRejected, TypeError, KeyboardInterrupt
        As :func:`verify` does.

    Warns
    -----
    GeodiskWarning
        Where the samples have normals of a file, and `to` is none; theirs are those of triangles.

    Examples
    --------
    >>> import geodisk, numpy as np
    >>> corners = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    >>> tetrahedron = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]
    >>> samples = geodisk.sample(corners, tetrahedron, min_distance=0.4)
    >>> larger = geodisk.transfer(samples, 2 * corners)
    >>> bool(larger.min_distance >= 0.8), np.allclose(larger.points, 2 * samples.points)
    (True, True)
    """
    source = mesh_under(samples, vertices, faces, edge_lengths, weld, keep_seams)
    if source is None:
        raise e.invalid("samples in a box have no mesh")
    own = source._surface
    wanted = Inherited(texture, normals, frames, up, attributes, has_colours=True)

    def make(record: Record, read: Sequence[str]) -> Mesh:
        if is_mesh(to):
            return mesh_of(
                to, **joins_for(to, own), attributes=read, record=record, allow_outside=allow_outside
            )
        if read:
            raise TypeError("attributes are for meshes from files")
        if own.walls:
            return posed(own, to, record)
        return Mesh(to, own.faces, **joins_for(to, own), _record=record)

    mesh, record = wanted.mesh(samples, (), make)
    target = mesh._surface
    _check_faces(own, target)
    dimension = target.dimension()
    made = run("transfer", samples, source._handle, tolerance, {"to": mesh._handle})
    placed: dict[str, Any] = {}
    if samples.face_index is None:
        placed["face_index"], placed["barycentric"] = places_of(*made[:2])
    points = np.frombuffer(made[2]).reshape(-1, max(dimension, 3))[:, :dimension].copy()
    directions = np.frombuffer(made[3], np.float32).reshape(-1, 3).astype(np.float64)
    distance = float(np.frombuffer(made[4])[0])
    transferred = dataclasses.replace(
        samples,
        **placed,
        points=points if dimension > 0 else None,
        normals=directions if dimension == 3 else None,
        radius=np.full(len(samples), distance / 2),
        min_distance=distance,
        class_distances=None,  # Those of the other pose.
        level_distances=None,
        report={"options": ["transfer"]},
        _surface=target,
        _job=None,
        _told={},
        _frame=None,
    )
    assert transferred.face_index is not None and transferred.barycentric is not None
    found = {
        name: one.at(transferred.face_index, transferred.barycentric)
        for name, one in target.attributes.items()
    }
    kept = {name: one for name, one in samples.attributes.items() if name not in _OF_ONE_POSE}
    transferred = dataclasses.replace(transferred, attributes={**kept, **found})
    transferred = recorded(transferred, mesh, record)
    wanted.warn_of_lost(samples, transferred)
    return transferred


def _check_faces(source: Surface, target: Surface) -> None:
    """Checks that a face and weights mean the same place, whichever vertices are joined."""
    needs = "transfer needs two meshes with identical faces"
    here, there = source.own_corners(), target.own_corners()
    if len(here) != len(there):
        raise e.invalid(f"pose: has {len(there)} triangles, but mesh has {len(here)}; {needs}")
    differing = np.flatnonzero((here != there).any(axis=1))
    if differing.size and (source.indices() != target.indices()).any():
        raise e.invalid(f"pose: face {differing[0]} has other corners than in mesh; {needs}")
