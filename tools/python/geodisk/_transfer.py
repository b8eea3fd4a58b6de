"""Samples on another pose of their mesh."""

from __future__ import annotations

import dataclasses
import json
import math
import os
from typing import Any, Sequence

import numpy as np
from numpy.typing import ArrayLike

from . import _errors as e
from ._inherited import Wanted
from ._inputs import surface_of, write_samples, write_surface
from ._mesh import Mesh, is_mesh, mesh_of
from ._program import folder, run
from ._protocols import Faces, MeshLike
from ._reading import read
from ._record import Record, recorded
from ._samples import Samples
from ._values import number, path_of

_OF_ONE_POSE = frozenset({"cover", "frames"})


def transfer(
    samples: Samples,
    to: ArrayLike | MeshLike,
    vertices: ArrayLike | MeshLike | None = None,
    faces: Faces | None = None,
    *,
    attributes: str | Sequence[str] = (),
    texture: str | os.PathLike[str] | None = None,
    normals: str | None = None,
    frames: bool | None = None,
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
        PNG or JPEG image whose colours to add, as ``attributes["color"]``, at the texture
        coordinates that the file `to` has. "auto" adds those of the materials of `to`.
    normals : {"face", "file", "smooth"}, optional
        Normals of triangles, those of the file `to`, or interpolated means at vertices. By default
        as the samples have them.
    frames : bool, optional
        Add ``attributes["frames"]``, shape (n, 4): quaternions (x, y, z, w) that turn z to the
        normal, after a random angle about z. By default if the samples have them.
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
        Samples with the same faces and weights, and their attributes but for ``cover``, which other
        poses change. `min_distance` is their smallest distance there, NaN if no path joins two
        samples, and `radius` is half of it.

    Raises
    ------
    InvalidArgument
        For samples that are not on their mesh, and for different faces.
    MeshRejected, TypeError, NoProgram, KeyboardInterrupt
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
    source = surface_of(samples, vertices, faces, edge_lengths, weld, keep_seams)
    if source is None:
        raise e.invalid("samples in a box have no mesh")
    wanted = Wanted(texture, normals, frames, attributes, has_colours=True)
    path = _path_of(to)
    own_faces, own_weld, own_seams = source.faces, source.weld, source.keep_seams

    def make(record: Record, read: Sequence[str]) -> Mesh:
        if is_mesh(to):
            return mesh_of(
                to, None, None, False, attributes=read, record=record, allow_outside=allow_outside
            )
        if read:
            raise TypeError("attributes are for meshes from files")
        return Mesh(to, own_faces, weld=own_weld, keep_seams=own_seams, _record=record)

    mesh, record = wanted.mesh(samples, (), make)
    target = mesh._surface
    with folder() as place:
        # A file has the corners from before vertices were joined.
        corners = None if path is None else source.own_corners()
        from_mesh, from_options = write_surface(place, source, "mesh", "-a", corners=corners)
        to_mesh, to_options = (
            write_surface(place, target, "pose", "-b")
            if path is None
            else (path, ["--allow-outside-b"] if allow_outside else [])
        )
        files = [write_samples(place, samples), from_mesh, to_mesh]
        outputs = ["--output", "there.npz", "--json", "report.json"]
        if tolerance is not None:
            outputs += ["--tolerance", repr(number(tolerance, "tolerance"))]
        run(place, ["transfer", *files, *from_options, *to_options, *outputs])
        there = read(place / "there.npz")
        closest = json.loads((place / "report.json").read_text("utf-8"))["smallest"]
    dimension = target.dimension()
    points = there.points
    if points is not None:  # The program has three coordinates in the plane.
        points = np.ascontiguousarray(points[:, :dimension])
    distance = math.nan if closest is None else float(closest["distance"])
    placed = {}
    if samples.face_index is None:
        placed = {"face_index": there.face_index, "barycentric": there.barycentric}
    moved = dataclasses.replace(
        samples,
        **placed,
        points=points,
        normals=there.normals if dimension == 3 else None,
        radius=np.full(len(samples), distance / 2),
        min_distance=distance,
        class_distances=None,  # Those of the other pose.
        report={"options": ["transfer"]},
        _surface=target,
        _job=None,
        _told={},
        _frame=None,
    )
    assert moved.face_index is not None and moved.barycentric is not None
    found = {
        name: one.at(moved.face_index, moved.barycentric)
        for name, one in target.attributes.items()
    }
    kept = {name: one for name, one in samples.attributes.items() if name not in _OF_ONE_POSE}
    moved = dataclasses.replace(moved, attributes={**kept, **found})
    moved = recorded(moved, mesh, record)
    wanted.warn_of_lost(samples, moved)
    return moved


def _path_of(mesh: Any) -> str | None:
    """Returns the path of a mesh file as the program takes it in any folder; None for others."""
    if not isinstance(mesh, (str, os.PathLike)):
        return None
    path = path_of(mesh, "to")
    return path if path.startswith("builtin:") else os.path.abspath(path)
