"""Samples on another pose of their mesh."""

from __future__ import annotations

import dataclasses
import json
import math

import numpy as np
from numpy.typing import ArrayLike

from . import _errors as e
from ._inputs import surface_of, write_samples, write_surface
from ._mesh import Mesh, is_mesh, mesh_of
from ._program import folder, run
from ._protocols import Faces, MeshLike
from ._reading import read
from ._samples import Samples


def transfer(
    samples: Samples,
    to: ArrayLike | MeshLike,
    vertices: ArrayLike | MeshLike | None = None,
    faces: Faces | None = None,
    *,
    edge_lengths: ArrayLike | None = None,
    weld: bool | float = False,
    keep_seams: bool = False,
) -> Samples:
    """Returns the same samples on another pose of their mesh, with identical faces.

    Parameters
    ----------
    samples : Samples
        Samples on a mesh, or points of other programs as for :func:`verify`.
    to : array_like of float, shape (v, d), or a mesh
        Positions of the vertices, or a mesh with identical faces.
    vertices, faces, edge_lengths, weld, keep_seams
        Mesh of the samples, as for :func:`sample`. Needed for samples that were read from a file.

    Returns
    -------
    Samples
        Samples with the same faces and weights. `min_distance` is their smallest distance there,
        NaN if no path joins two samples, and `radius` is half of it.

    Raises
    ------
    InvalidArgument
        For samples that are not on their mesh, and for different faces.
    MeshRejected, TypeError, NoProgram, KeyboardInterrupt
        As :func:`verify` does.

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
    if is_mesh(to):
        target = mesh_of(to, None, None, False)._surface
    else:
        target = Mesh(
            to, source.faces, weld=source.weld, keep_seams=source.keep_seams
        )._surface
    with folder() as place:
        from_mesh, from_options = write_surface(place, source, "mesh", "-a")
        to_mesh, to_options = write_surface(place, target, "pose", "-b")
        files = [write_samples(place, samples), from_mesh, to_mesh]
        outputs = ["--output", "there.npz", "--json", "report.json"]
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
    return dataclasses.replace(
        samples,
        **placed,
        points=points,
        normals=there.normals if dimension == 3 else None,
        radius=np.full(len(samples), distance / 2),
        min_distance=distance,
        report={},
        _surface=target,
    )
