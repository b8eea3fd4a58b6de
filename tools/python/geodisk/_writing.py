"""Samples as files, as the program geodisk writes and reads them."""

from __future__ import annotations

import dataclasses
import json
import math
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from . import _errors as e
from . import _library as c
from ._attributes import columns_of_attributes, is_colour, with_bytes
from ._files import bytes_of
from ._job import option_of

if TYPE_CHECKING:
    from ._samples import Samples

Header = dict[str, str]

#: Columns of samples besides those of WHOLE_COLUMNS.
OWN_COLUMNS = (
    *("x y z nx ny nz face_index bary_u bary_v bary_w radius polygon_index order").split(),
    *(f"x{axis}" for axis in range(8)),
)

#: Arrays of samples in NPZ files, besides those of WHOLE_COLUMNS.
ARRAYS = ("points", "normals", "face_index", "barycentric", "radius", "polygon_index")

#: Among the options of samples that are some of their set.
SELECTION = "selection"

#: Names of columns of whole numbers: what part of its file a triangle lies in, whether the sample
#: was given, its class, its feature, its level, and the vertex that it is at.
WHOLE_COLUMNS = tuple(
    "mesh primitive node material group part existing class feature level vertex".split()
)

#: Names in NPZ files that are none of attributes.
MEMBERS = {*ARRAYS, *WHOLE_COLUMNS, "header", "min_distance", "seed"}


def header_of(samples: Samples) -> Header:
    """What files say besides the columns, by key."""
    header = {"version": f"geodisk {c.version()}", "sampling_version": str(c.sampling_version())}
    if not math.isnan(samples.min_distance):
        header["min_distance"] = repr(samples.min_distance)
        header["radius"] = repr(samples.min_distance / 2)
    if samples.class_distances is not None:
        rows = [",".join(map(repr, row)) for row in samples.class_distances.tolist()]
        header["classes"] = ";".join(rows) + (";" if len(rows) == 1 else "")
    if samples.seed is not None:
        header["seed"] = str(samples.seed)
    options = list(samples.report.get("options", []))
    if samples.face_index is not None and samples.barycentric is not None:
        header["digest"] = digest_of(samples.face_index, samples.barycentric)
        if not samples._is_whole() and SELECTION not in options:
            options.append(SELECTION)
    if samples._frame is not None:
        header["job_frame"] = samples._frame.digits
    if samples._record is not None and samples._record.normals != "face":
        header["normals"] = samples._record.normals
    if samples._record is not None and samples._record.frames is not None:
        header["frames"] = samples._record.frames
        if samples._record.up is not None:
            header["frames_up"] = samples._record.up
    if samples.level_distances is not None:
        header["order"] = "progressive"
        header["level_distances"] = " ".join(map(repr, samples.level_distances))
        if samples.level is not None:
            counts = np.bincount(samples.level, minlength=len(samples.level_distances))
            header["level_samples"] = " ".join(map(str, np.cumsum(counts)))
    if samples.extents is not None:
        header["box"] = " x ".join(map(repr, samples.extents))
        header["sides"] = "periodic" if samples.periodic else "open"
    elif samples.points is not None and samples.points.shape[1] < 3:
        header["dimension"] = str(samples.points.shape[1])  # Since x y z are there in any case.
    header.update(samples._told)
    told = set(map(option_of, header))
    if others := [name for name in options if name not in told]:
        header["options"] = " ".join(others)
    return header


def digest_of(faces: NDArray[np.uint32], weights: NDArray[np.float64]) -> str:
    """The sum of the FNV-1a hashes of samples, as the program has it."""
    words = np.column_stack([faces, weights.astype(np.float32).view(np.uint32)])
    hashes = np.full(len(words), 0xCBF29CE484222325, np.uint64)
    for word in words.T.astype(np.uint64):
        for shift in range(0, 32, 8):
            hashes ^= word >> np.uint64(shift) & np.uint64(0xFF)
            hashes *= np.uint64(0x100000001B3)
    return f"{int(hashes.sum(dtype=np.uint64)):016x}"


def check_names(attributes: dict[str, NDArray[Any]]) -> None:
    """Raises if an attribute has the name of something else that files have."""
    taken = {*OWN_COLUMNS, *MEMBERS}
    for name in [*attributes, *columns_of_attributes(attributes)]:
        if name in taken:
            raise e.invalid(
                f"the attribute {name!r} has the name of a column of samples; rename it, such as "
                f"samples.attributes['my_{name}'] = samples.attributes.pop({name!r})"
            )


def has_own_radii(samples: Samples) -> bool:
    """Whether radii are others than half the minimum distance, which is that of the classes."""
    if len(samples) == 0 or np.ptp(samples.radius) > 0:
        return len(samples) > 0
    half, own = samples.min_distance / 2, float(samples.radius[0])
    return half > 0 and samples.class_distances is None and not math.isclose(own, half, rel_tol=1e-6)


def columns_of(samples: Samples, as_box: bool) -> dict[str, NDArray[Any]]:
    """Returns columns by name. Coordinates are x y z, or with `as_box` no more than there are."""
    columns: dict[str, NDArray[Any]] = {}
    if samples.points is not None:
        dimension = samples.points.shape[1]
        names = [f"x{axis}" for axis in range(dimension)] if dimension > 3 else list("xyz")
        columns.update(zip(names, samples.points.T))
        if not as_box:
            columns.update({name: np.zeros(len(samples)) for name in names[dimension:]})
    if samples.normals is not None:
        columns.update(zip(("nx", "ny", "nz"), samples.normals.T))
    if samples.face_index is not None and samples.barycentric is not None:
        columns["face_index"] = samples.face_index
        columns.update(zip(("bary_u", "bary_v", "bary_w"), samples.barycentric.T))
    if has_own_radii(samples):
        columns["radius"] = samples.radius
    if samples.polygon_index is not None:
        columns["polygon_index"] = samples.polygon_index
    columns.update(samples.columns)
    columns.update(columns_of_attributes(samples.attributes))
    return columns


def write_npz(file: BinaryIO, samples: Samples, header: Header) -> None:
    arrays: dict[str, Any] = {
        **{name: getattr(samples, name) for name in ARRAYS},
        **samples.columns,
        **samples.attributes,
        "min_distance": np.float64(samples.min_distance),
        "seed": None if samples.seed is None else np.uint64(samples.seed),
        "header": np.array(json.dumps(header)),
    }
    np.savez(file, **{name: array for name, array in arrays.items() if array is not None})


def write_csv(file: BinaryIO, samples: Samples, header: Header) -> None:
    columns = columns_of(samples, as_box=samples.extents is not None)
    entries = {**header, "samples": str(len(samples))}
    lines = [f"# {key}: {value}\n" for key, value in entries.items()]
    file.write(("".join(lines) + ",".join(columns) + "\n").encode())
    formats = [_format_of(name, column) for name, column in columns.items()]
    np.savetxt(file, np.stack(list(columns.values()), axis=1), fmt=formats, delimiter=",")


#: Formats that the library writes.
OTHER_FORMATS = (".pcd", ".obj", ".xyz", ".glb", ".gltf", ".usda", ".vtp", ".star")


def bytes_as(suffix: str, samples: Samples, pixel_size: float | None = None) -> bytes:
    """Returns the file that the program writes of samples in one of OTHER_FORMATS."""
    columns = columns_of(dataclasses.replace(samples, attributes={}), as_box=False)
    fields = []
    for name, array in samples.attributes.items():
        own = columns_of_attributes({name: array})
        fields.append(
            {
                "name": name,
                "components": list(own),
                "first": len(columns),
                "whole": array.dtype.kind != "f",
                "colour": is_colour(name, array),
            }
        )
        columns.update(own)
    table = np.stack(list(columns.values()), axis=1).astype(np.float64, order="C")
    return bytes_of(
        suffix,
        lambda path: c.run(
            "save", {"samples": table}, columns=list(columns), count=len(samples), path=path,
            fields=fields, header=header_of(samples), pixel_size=pixel_size,
        ),
    )


def is_whole(column: NDArray[Any]) -> bool:
    """Whether all numbers are integers that fit int32."""
    return bool(((np.abs(column) < 2**31) & (np.rint(column) == column)).all())


def _format_of(name: str, column: NDArray[Any]) -> str:
    """Returns a format that keeps all digits, by which attributes of floats differ from integers."""
    if column.dtype.kind != "f":
        return "%d"
    return "%.1f" if name not in OWN_COLUMNS and is_whole(column) else "%.17g"


def write_ply(file: BinaryIO, samples: Samples, header: Header) -> None:
    columns = columns_of(samples, as_box=False)
    columns.update(columns_of_attributes(with_bytes(samples.attributes)))
    kinds = {"f": ("double", "<f8"), "u": ("uint", "<u4"), "i": ("int", "<i4")}
    types = [
        ("uchar", "u1") if x.dtype == np.uint8 else kinds[x.dtype.kind] for x in columns.values()
    ]
    lines = ["ply", "format binary_little_endian 1.0"]
    lines += [f"comment {key}: {value}" for key, value in header.items()]
    lines += [f"element vertex {len(samples)}"]
    lines += [f"property {kind} {name}" for name, (kind, _) in zip(columns, types)]
    file.write("\n".join([*lines, "end_header\n"]).encode())
    records = np.empty(len(samples), [(name, scalar) for name, (_, scalar) in zip(columns, types)])
    for name, column in columns.items():
        records[name] = column
    file.write(records.tobytes())
