"""Samples that follow an edit of their mesh."""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import ArrayLike

from . import _errors as e
from ._inputs import surface_of, write_samples, write_surface
from ._mesh import Mesh, is_mesh, mesh_of
from ._program import folder, run
from ._protocols import Faces, MeshLike
from ._reading import read
from ._samples import Samples


def update(
    samples: Samples,
    to: ArrayLike | MeshLike,
    to_faces: Faces | None = None,
    *,
    vertices: ArrayLike | MeshLike | None = None,
    faces: Faces | None = None,
    weld: bool | float = False,
    keep_seams: bool = False,
) -> Samples:
    """Returns the samples of an edited mesh, and decides only what the edit can reach.

    The samples are those of a whole run over the edited mesh with the same seed and distance, in
    the frame of the mesh before: see "Updates" in the documentation.

    Parameters
    ----------
    samples : Samples
        All samples of a run on the mesh before, by a distance or count alone: of one radius, the
        default pool, and without a mask.
    to : array_like of float, shape (v, d), or a mesh
        The edited mesh, or positions of its vertices.
    to_faces : array_like of int, optional
        Faces of the edited mesh; those of the mesh before by default.
    vertices, faces, weld, keep_seams
        Mesh before the edit, as for :func:`sample`. Needed for samples that were read from a file.

    Returns
    -------
    Samples
        Samples on the edited mesh. Those far from the edit are as before.

    Raises
    ------
    InvalidArgument
        For samples that are not on their mesh or of another run than above, and for an edge that
        became too long.
    MeshRejected, TypeError, NoProgram, KeyboardInterrupt
        As :func:`verify` does.

    Examples
    --------
    >>> import geodisk, numpy as np
    >>> corners = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    >>> tetrahedron = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]
    >>> samples = geodisk.sample(corners, tetrahedron, min_distance=0.4, seed=1)
    >>> moved = corners.copy()  # The samples refer to the array before.
    >>> moved[0] *= 1.2
    >>> edited = geodisk.update(samples, moved)
    >>> whole = geodisk.sample(moved, tetrahedron, min_distance=0.4, seed=1)
    >>> np.array_equal(edited.points, whole.points)
    True
    """
    source = surface_of(samples, vertices, faces, None, weld, keep_seams)
    if source is None:
        raise e.invalid("samples in a box have no mesh")
    if samples.seed is None or not samples.min_distance > 0:
        raise e.invalid("these samples do not know their seed and minimum distance")
    if others := samples.report.get("options"):
        raise e.invalid(
            f"samples made with {', '.join(others)} cannot be updated; sample the mesh again"
        )
    if len(samples) != samples.report.get("samples", len(samples)):
        raise e.invalid(
            f"these are {len(samples)} of {samples.report['samples']} samples; give all of them"
        )
    if is_mesh(to):
        target = mesh_of(to, to_faces, None, False)._surface
    else:
        corners = source.own_corners() if to_faces is None else to_faces
        target = Mesh(to, corners, weld=source.weld, keep_seams=source.keep_seams)._surface
    with folder() as place:
        before, _ = write_surface(place, source, "before")
        after, options = write_surface(place, target, "after")
        job = ["--min-distance", repr(float(samples.min_distance)), "--seed", str(samples.seed)]
        edit = ["--from", before, "--update", write_samples(place, samples)]
        run(place, ["sample", after, "--output", "edited.npz", *options, *job, *edit])
        there = read(place / "edited.npz")
    dimension = target.dimension()
    points = there.points
    if points is not None:  # The program has three coordinates in the plane.
        points = np.ascontiguousarray(points[:, :dimension])
    return dataclasses.replace(
        there,
        points=points,
        normals=there.normals if dimension == 3 else None,
        _surface=target,
    )
