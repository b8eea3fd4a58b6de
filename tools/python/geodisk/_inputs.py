"""Meshes and samples as files for the program geodisk, exact to the bit."""

from __future__ import annotations

import dataclasses
import pathlib
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from ._mesh import mesh_of
from ._protocols import Faces, MeshLike
from ._samples import Samples
from ._surface import Surface
from ._values import flag, weld_of
from ._writing import columns_of, header_of, write_ply


def surface_of(
    samples: Samples,
    vertices: ArrayLike | MeshLike | None,
    faces: Faces | None,
    edge_lengths: ArrayLike | None,
    weld: bool | float,
    keep_seams: bool = False,
) -> Surface | None:
    """The surface that arguments name, else the one of the samples; None for samples in a box."""
    if not isinstance(samples, Samples):
        raise TypeError(
            f"samples are a geodisk.Samples, as geodisk.read has them of a file, not "
            f"{type(samples).__name__}"
        )
    if vertices is not None:
        if samples.face_index is None and samples.extents is not None:
            raise e.invalid("samples in a box lie on no mesh")
        return mesh_of(vertices, faces, edge_lengths, weld, keep_seams)._surface
    is_joined = weld_of(weld) is not False or flag(keep_seams, "keep_seams")
    if faces is not None or edge_lengths is not None or is_joined:
        raise TypeError(
            "faces, edge_lengths, weld and keep_seams are of a mesh whose vertices are given"
        )
    if samples._surface is None and samples.extents is None:
        raise e.invalid("these samples do not know their mesh, so it has to be given")
    return samples._surface


def write_samples(folder: pathlib.Path, samples: Samples) -> str:
    """Writes them to a file; its name."""
    samples = dataclasses.replace(samples, attributes={})  # The program needs none.
    with open(folder / "samples.ply", "wb") as file:
        write_ply(file, samples, header_of(samples))
    return "samples.ply"


def write_subject(
    folder: pathlib.Path,
    samples: Samples,
    surface: Surface | None,
    mask: NDArray[np.uint8] | None = None,
) -> list[str]:
    """Writes samples and their surface, where they lie on one; the arguments that name them.

    A mask has a byte per triangle, 1 where it takes samples.
    """
    if surface is None:
        return [write_samples(folder, samples)]
    mesh, options = write_surface(folder, surface, mask=mask)
    return [mesh, write_samples(folder, samples), *options]


def write_surface(
    folder: pathlib.Path,
    surface: Surface,
    name: str = "mesh",
    suffix: str = "",
    mask: NDArray[np.uint8] | None = None,
    corners: NDArray[Any] | None = None,
) -> tuple[str, list[str]]:
    """Writes it to files; the name of the mesh, and options that end with `suffix`.

    Its faces have these corners, if given.
    """
    faces = surface.indices() if corners is None else corners
    options = []
    if surface.weld is not False:
        value = "" if surface.weld is True else float(surface.weld)
        options.append(f"--weld{suffix}={value!r}" if value else f"--weld{suffix}")
    if surface.keep_seams:
        options.append(f"--keep-seams{suffix}")
    if surface.edge_lengths is None:
        columns = _as_columns(surface.coordinates())
        count = len(surface.coordinates())
    else:
        columns, count = {}, int(surface.vertices)
        lengths = f"{name}-lengths.txt"
        _write_lengths(folder / lengths, faces, surface.lengths())
        options += [f"--edge-lengths{suffix}", lengths]
    with open(folder / f"{name}.ply", "wb") as file:
        lines = ["ply", "format binary_little_endian 1.0", f"element vertex {count}"]
        lines += [f"property double {axis}" for axis in columns]
        lines += [f"element face {len(faces)}", "property list uchar uint vertex_indices"]
        kinds: list[Any] = [("corners", "u1"), ("face", "<u4", 3)]
        if mask is not None:
            lines.append("property uchar face_mask")
            kinds.append(("mask", "u1"))
            options += ["--mask", "face_mask=1"]
        file.write("\n".join([*lines, "end_header\n"]).encode())
        if columns:
            file.write(np.stack(list(columns.values()), axis=1).astype("<f8").tobytes())
        records = np.empty(len(faces), kinds)
        records["corners"], records["face"] = 3, faces
        if mask is not None:
            records["mask"] = mask
        file.write(records.tobytes())
    return f"{name}.ply", options


def write_density(
    folder: pathlib.Path, surface: Surface, name: str, values: ArrayLike
) -> list[str]:
    """Writes the `density` or `radius_factor` of vertices; the option that names the file."""
    array = surface.vertex_values(values, name)
    corners = surface.indices()
    small = corners[array[corners] < 0.001]  # Which the program raises, and the library refuses.
    if name == "radius_factor" and small.size > 0:
        raise e.invalid(f"the {name} of vertex {small[0]} is {array[small[0]]}, below 0.001")
    np.savetxt(folder / "density.txt", array, fmt="%.17g")
    return ["--" + name.replace("_", "-"), "file:density.txt"]


def write_avoided(
    folder: pathlib.Path, surface: Surface, points: NDArray[Any], radii: NDArray[np.float64]
) -> list[str]:
    """Writes points to avoid with their radii; the option that names the file."""
    faces, weights = points["face"], points["weights"].astype(np.float64)
    corners = surface.indices()
    if int(faces.max()) >= len(corners):
        first = int(np.argmax(faces >= len(corners)))
        raise e.invalid(
            f"avoid: point {first} is in face {faces[first]}, the mesh has {len(corners)}"
        )
    wrong = ~((radii > 0) & np.isfinite(radii))
    if wrong.any():
        first = int(np.argmax(wrong))
        raise e.invalid(f"avoid: point {first} has the radius {radii[first]}, not a positive one")
    places = None
    if surface.edge_lengths is None:
        places = np.einsum("ij,ijk->ik", weights, surface.coordinates()[corners[faces]])
    columns = columns_of(Samples(places, face_index=faces, barycentric=weights), as_box=False)
    columns["avoid_radius"] = radii
    np.savetxt(
        folder / "avoid.csv",
        np.column_stack(list(columns.values())),
        fmt="%.17g",
        delimiter=",",
        header=",".join(columns),
        comments="",
    )
    return ["--avoid", "avoid.csv:avoid_radius"]


def _as_columns(coordinates: NDArray[Any]) -> dict[str, NDArray[Any]]:
    """By name; a mesh in the plane lies in that of z = 0."""
    dimension = coordinates.shape[1]
    names = [f"x{axis}" for axis in range(dimension)] if dimension > 3 else ["x", "y", "z"]
    columns = dict(zip(names, coordinates.T))
    return columns if dimension > 2 else {**columns, "z": np.zeros(len(coordinates))}


def _write_lengths(
    path: pathlib.Path, faces: NDArray[Any], lengths: NDArray[np.float64]
) -> None:
    """A line for each edge."""
    ends = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2)
    edges, first = np.unique(np.sort(ends, axis=1), axis=0, return_index=True)
    table = np.column_stack([edges, lengths.ravel()[first]])
    np.savetxt(path, table, fmt=["%d", "%d", "%.17g"])
