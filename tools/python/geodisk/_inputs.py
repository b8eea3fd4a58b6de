"""Commands of the program on samples and their mesh."""

from __future__ import annotations

import dataclasses
from typing import Any, Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from . import _library as c
from ._background import interruptible
from ._mesh import Mesh, is_joined_by, mesh_of, prepared
from ._protocols import Faces, MeshLike
from ._samples import Samples
from ._values import number
from ._writing import columns_of, header_of


def mesh_under(
    samples: Samples,
    vertices: ArrayLike | MeshLike | None,
    faces: Faces | None,
    edge_lengths: ArrayLike | None,
    weld: bool | float,
    keep_seams: bool,
) -> Mesh | None:
    """Returns the mesh that arguments name, else that of the samples; None for samples in a box."""
    if not isinstance(samples, Samples):
        raise TypeError(
            f"samples are a geodisk.Samples, as geodisk.read has them of a file, not "
            f"{type(samples).__name__}"
        )
    if vertices is not None:
        if samples.face_index is None and samples.extents is not None:
            raise e.invalid("samples in a box lie on no mesh")
        return mesh_of(
            vertices, faces, edge_lengths=edge_lengths, weld=weld, keep_seams=keep_seams
        )
    if is_joined_by(weld, keep_seams) or faces is not None or edge_lengths is not None:
        raise TypeError(
            "faces, edge_lengths, weld and keep_seams are of a mesh whose vertices are given"
        )
    if samples._surface is None and samples.extents is None:
        raise e.invalid("these samples do not know their mesh, so it has to be given")
    return None if samples._surface is None else prepared(samples._surface)


def run(
    command: str,
    samples: Samples | None = None,
    mesh: c.Handle | None = None,
    tolerance: float | None = None,
    arrays: Mapping[str, c.Handle | NDArray[Any] | None] = {},
    **options: Any,
) -> list[bytes]:
    """Returns what a command of the program makes of samples on the library's mesh, or in a box.

    `arrays` are fields of the task.
    """
    given: dict[str, c.Handle | NDArray[Any] | None] = {"mesh": mesh, **arrays}
    if samples is not None:
        samples = dataclasses.replace(samples, attributes={})  # None is needed.
        columns = columns_of(samples, as_box=mesh is None)
        given["samples"] = np.stack(list(columns.values()), axis=1).astype(np.float64, order="C")
        options.update(columns=list(columns), count=len(samples), header=header_of(samples))
        options["tolerance"] = option(tolerance, "tolerance")
    return interruptible(lambda stop: c.run(command, given, stop, **options))


def option(value: float | None, name: str) -> str:
    """Returns a number as options of the program have it; "" for None."""
    return "" if value is None else repr(number(value, name))


def places_of(faces: bytes, weights: bytes) -> tuple[NDArray[np.uint32], NDArray[np.float64]]:
    """Returns the faces and weights that a command makes."""
    rows = np.frombuffer(weights, np.float32).reshape(-1, 3)
    return np.frombuffer(faces, np.uint32).copy(), rows.astype(np.float64)
