"""Points of other programs, put on the nearest triangles of a mesh."""

from __future__ import annotations

import dataclasses

import numpy as np

from . import _errors as e
from ._inputs import write_samples, write_surface
from ._program import folder, run
from ._reading import read
from ._samples import Samples
from ._surface import Surface


def placed_on(surface: Surface, samples: Samples, name: str) -> Samples:
    """Returns samples with the triangles and weights that they have, or that are nearest.

    Raises for points that are farther off than a thousandth of the bounding-box diagonal. `name`
    is the argument that they are.
    """
    if samples.face_index is not None:
        return samples
    if samples.extents is not None:
        raise e.invalid(f"{name}: samples in a box lie on no mesh")
    if len(samples) == 0:
        return Samples(face_index=np.empty(0, np.uint32), barycentric=np.empty((0, 3)))
    with folder() as place:
        mesh, options = write_surface(place, surface, "mesh", "-a")
        options += [option.replace("-a", "-b") if option.startswith("--") else option for option in options]
        try:
            files = [write_samples(place, samples), mesh, mesh]
            run(place, ["transfer", *files, *options, "--output", "there.npz"])
        except e.InvalidArgument as error:
            message = str(error).replace("samples: ", "", 1)
            if "than tolerance allows" in message:
                message = message.replace(
                    "off mesh than tolerance allows", "off the mesh than a thousandth of its diagonal"
                )
            raise e.invalid(f"{name}: {message}") from None
        there = read(place / "there.npz")
    return dataclasses.replace(
        samples, points=None, normals=None, face_index=there.face_index, barycentric=there.barycentric
    )
