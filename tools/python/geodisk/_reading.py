"""Samples from files that geodisk wrote."""

from __future__ import annotations

import errno
import json
import math
import os
import zipfile
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from . import _errors as e
from . import _library as c
from ._attributes import attributes_of_columns
from ._job import JobFrame, option_of, values
from ._record import Record
from ._samples import Samples
from ._values import path_of
from ._writing import ARRAYS, MEMBERS, OWN_COLUMNS, WHOLE_COLUMNS, Header, is_whole

Columns = dict[str, NDArray[Any]]


def read(path: str | os.PathLike[str]) -> Samples:
    """Reads samples from a file of :meth:`Samples.save` or of the program ``geodisk``.

    Parameters
    ----------
    path : str or path-like
        ``*.npz``, ``*.csv`` or ``*.ply``, the latter as text or binary.

    Returns
    -------
    Samples
        Equal to those that were saved, but `order` counts those of the file. `min_distance` is NaN and `seed` None if the file does not
        have them. They do not refer to their mesh.

    Raises
    ------
    InvalidArgument
        For a file without samples, or damaged or cut short, naming it and the cause.
    OSError
        If the file cannot be read.

    Notes
    -----
    CSV and PLY files of the program hold weights and normals in single precision; PLY also holds
    points in single precision if that is enough. NPZ holds everything.

    Examples
    --------
    >>> import geodisk, os, tempfile
    >>> samples = geodisk.sample_box([1, 2], min_distance=0.2, periodic=True)
    >>> path = os.path.join(tempfile.mkdtemp(), "box.csv")
    >>> samples.save(path)
    >>> again = geodisk.read(path)
    >>> bool((again.points == samples.points).all()), again.extents, again.periodic
    (True, (1.0, 2.0), True)
    """
    path = path_of(path)
    readers = {".npz": _from_npz, ".csv": _from_csv, ".ply": _from_ply}
    reader = readers.get(os.path.splitext(path)[1].lower())
    if reader is None:
        raise e.invalid(f"{path}: samples are read from *.npz, *.csv and *.ply")
    with open(path, "rb") as file:
        try:
            return reader(file)
        except MemoryError:
            raise
        except Exception as error:  # Broken archives make numpy raise nearly anything.
            # Errors of the system are not about what the file holds, but for a wrong offset in an archive.
            if isinstance(error, OSError) and error.errno not in (None, errno.EINVAL):
                raise
            raise e.invalid(f"{path}: {error or type(error).__name__}") from error


def _samples(header: Header, **arrays: Any) -> Samples:
    """Samples of those arrays, and of what the header tells."""
    if "box" in header:
        arrays["extents"] = tuple(float(side) for side in header["box"].split(" x "))
        arrays["periodic"] = header.get("sides") == "periodic"
    elif arrays.get("face_index") is None:
        raise ValueError("has neither face_index nor a box, so it holds no samples of geodisk")
    arrays["min_distance"] = float(header.get("min_distance", math.nan))
    if "classes" in header:
        arrays["class_distances"] = _class_distances(header["classes"], arrays["min_distance"])
    if "level_distances" in header:
        arrays["level_distances"] = tuple(map(float, header["level_distances"].split()))
    arrays["_digest"] = header.get("digest")
    options = header.get("options", "").split()
    for told in map(option_of, header):
        if told is not None and told not in options:
            options.append(told)
    arrays["_told"] = {key: header[key] for key in values() if key in header}
    if header.get("sampling_version", str(c.sampling_version())) != str(c.sampling_version()):
        options.append(f"sampling_version={header['sampling_version']}")
    if options:
        arrays["report"] = {"options": options}
    if "version" in header:
        arrays["_record"] = Record(
            None,
            header.get("normals", "face"),
            "frames" in arrays.get("attributes", {}) and header.get("frames", True),
            header.get("frames_up"),
        )
    arrays["seed"] = int(header["seed"]) if "seed" in header else None
    arrays["_frame"] = JobFrame(header["job_frame"]) if "job_frame" in header else None
    return Samples(**arrays)


def _class_distances(text: str, distance: float) -> NDArray[np.float64]:
    """Returns the distances of classes that the header says: a table, or the number of classes."""
    if ";" in text:
        rows = text.rstrip(";").split(";")
        return np.array([[float(x) for x in row.split(",")] for row in rows])
    count = int(text)
    table = np.full((count, count), distance / math.sqrt(count))
    np.fill_diagonal(table, distance)
    return table


def _from_npz(file: BinaryIO) -> Samples:
    if not zipfile.is_zipfile(file):
        raise ValueError("is not a numpy archive, or is cut short")
    file.seek(0)
    with np.load(file, allow_pickle=False) as archive:
        header = json.loads(str(archive["header"])) if "header" in archive else {}
        header.update({n: str(archive[n]) for n in ("min_distance", "seed") if n in archive})
        arrays = {name: archive[name] for name in ARRAYS if name in archive}
        columns = {name: archive[name] for name in WHOLE_COLUMNS if name in archive}
        rows = len(next(iter(arrays.values()), ()))
        others = {name: archive[name] for name in archive if name not in MEMBERS}
        attributes = {
            name: x
            for name, x in others.items()
            if x.ndim in (1, 2) and len(x) == rows and x.dtype.kind in "biuf"
        }
    return _samples(header, columns=columns, attributes=attributes, **arrays)


def _whole(columns: Columns, name: str) -> NDArray[Any] | None:
    """Returns a column of integers, which text has as floats; None if there is none."""
    numbers = columns.get(name)
    if numbers is None or numbers.dtype.kind != "f":
        return numbers
    with np.errstate(invalid="ignore"):
        whole = numbers.astype(np.int64)
    if not (whole == numbers).all():
        raise ValueError(f"{name} has numbers that are not whole")
    return whole


def _of_columns(columns: Columns, header: Header) -> Samples:
    def table(*names: str) -> NDArray[Any] | None:
        there = [columns[name] for name in names if name in columns]
        return np.stack(there, axis=1).astype(np.float64) if there else None

    points = table(*(f"x{axis}" for axis in range(8)))
    points = table("x", "y", "z") if points is None else points
    if points is not None and ("box" in header or "dimension" in header):
        sides = len(header["box"].split(" x ")) if "box" in header else int(header["dimension"])
        points = np.ascontiguousarray(points[:, :sides])
    return _samples(
        header,
        points=points,
        normals=table("nx", "ny", "nz"),
        face_index=_whole(columns, "face_index"),
        polygon_index=_whole(columns, "polygon_index"),
        barycentric=table("bary_u", "bary_v", "bary_w"),
        radius=columns.get("radius"),
        columns={name: _whole(columns, name) for name in WHOLE_COLUMNS if name in columns},
        attributes=attributes_of_columns(
            {name: x for name, x in columns.items() if name not in {*OWN_COLUMNS, *WHOLE_COLUMNS}}
        ),
    )


def _text_columns(lines: list[str], names: list[str], delimiter: str | None) -> Columns:
    rows = np.empty((0, len(names)))
    if lines:
        rows = np.loadtxt(lines, delimiter=delimiter, comments=None, ndmin=2)
    if rows.shape[1] != len(names):
        raise ValueError(f"has {rows.shape[1]} columns, but names of {len(names)}")
    return dict(zip(names, rows.T))


def _with_integers(columns: Columns, lines: list[str]) -> Columns:
    """Returns the columns of attributes as int32 where their text has integers alone."""
    found = dict(columns)
    for index, (name, column) in enumerate(columns.items()):
        if name not in OWN_COLUMNS and is_whole(column):
            texts = (line.split(",")[index].strip() for line in lines)
            if all(text.removeprefix("-").isdigit() for text in texts):
                found[name] = column.astype(np.int32)
    return found


def _add_entry(header: Header, text: str) -> None:
    key, colon, value = text.partition(": ")
    if colon:
        header.setdefault(key.strip(), value.strip())


def _lines(file: BinaryIO) -> list[str]:
    text = file.read().decode("utf-8", "replace")
    if text and not text.endswith("\n"):
        raise ValueError("ends within a line")
    return text.splitlines()


def _from_csv(file: BinaryIO) -> Samples:
    header: Header = {}
    lines = []
    for line in _lines(file):
        if line.startswith("#"):
            _add_entry(header, line[1:])
        elif line.strip():
            lines.append(line)
    if not lines:
        raise ValueError("has no names of columns")
    names = [name.strip() for name in lines[0].split(",")]
    count = header.pop("samples", None)
    if count is not None and count != str(len(lines) - 1):
        raise ValueError(f"has {len(lines) - 1} samples, but its header says {count}")
    columns = _text_columns(lines[1:], names, ",")
    return _of_columns(_with_integers(columns, lines[1:]), header)


_TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4",
    "float": "f4", "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2",
    "int32": "i4", "uint32": "u4", "float32": "f4", "float64": "f8",
}  # fmt: skip


def _from_ply(file: BinaryIO) -> Samples:
    header: Header = {}
    orders = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
    order, count, types = None, None, []
    if file.readline(100).strip() != b"ply":
        raise ValueError("does not begin as PLY does")
    while True:
        line = file.readline()
        if not line.endswith(b"\n"):
            raise ValueError("ends within the header")
        words = line.decode("utf-8", "replace").split()
        if words == ["end_header"]:
            break
        if words[:1] == ["comment"]:
            _add_entry(header, line.decode("utf-8", "replace").strip()[8:])
        elif words[:1] == ["format"] and len(words) == 3 and words[1] in orders:
            order = orders[words[1]]
        elif words[:2] == ["element", "vertex"] and len(words) == 3 and count is None:
            count = int(words[2])
        elif words[:1] == ["property"] and len(words) == 3 and words[1] in _TYPES:
            types.append((words[2], _TYPES[words[1]]))
        else:
            raise ValueError(f"has the header line {' '.join(words)!r}, which samples have not")
    if order is None or count is None or not types:
        raise ValueError("has no format, or no element vertex with properties")
    names = [name for name, _ in types]
    if order == "":
        columns = _text_columns(_lines(file), names, None)
        columns.update({n: columns[n].astype(t) for n, t in types if not t.startswith("f")})
    else:
        kind = np.dtype([(name, order + scalar) for name, scalar in types])
        data = file.read()
        if len(data) != count * kind.itemsize:
            raise ValueError(
                f"has {len(data)} bytes of samples instead of {count * kind.itemsize}"
            )
        records = np.frombuffer(data, kind)
        columns = {name: records[name] for name in names}
    if any(len(column) != count for column in columns.values()):
        raise ValueError(f"does not have {count} samples, as its header tells")
    return _of_columns(columns, header)
