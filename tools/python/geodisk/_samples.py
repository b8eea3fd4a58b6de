"""The result of a run."""

from __future__ import annotations

import ctypes
import math
import os
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._arrays import indices, real
from ._files import complete
from ._surface import Surface
from ._writing import header_of, write_csv, write_npz, write_ply


def _table(values: ArrayLike, name: str, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """As float64 of that shape, all finite."""
    array = real(values, name).astype(np.float64, copy=False)
    if array.shape != shape:
        raise e.invalid(f"{name} have the shape {array.shape}, not {shape}")
    if not np.isfinite(array).all():
        place = np.argwhere(~np.isfinite(array))[0]
        raise e.invalid(f"{name}[{', '.join(map(str, place))}] is {array[tuple(place)]}")
    return array


@dataclass(frozen=True, eq=False, repr=False)
class Samples:
    """Samples, in the order of the darts: the first n of them are the set of the first n.

    :func:`sample`, :func:`sample_box`, :func:`transfer` and :func:`read` make them; those of other
    programs are made of their arrays, to verify or draw them.

    Attributes
    ----------
    points : ndarray of float64, shape (n, d) or None
        Where they are; None on a mesh of lengths.
    normals : ndarray of float64, shape (n, 3) or None
        Of their triangles, on meshes in three dimensions.
    face_index : ndarray of uint32, shape (n,) or None
        Their triangles, on meshes.
    barycentric : ndarray of float64, shape (n, 3) or None
        Weights of their triangles' corners. They sum to 1.
    radius : ndarray of float64, shape (n,)
        Half the minimum distance, or where radii vary, of each.
    order : ndarray of int64, shape (n,)
        Their places in the order of the darts.
    min_distance : float
        No two are closer along the surface; where radii vary, two with the largest ones. NaN where
        that is not known.
    seed : int or None
    extents : tuple of float or None
        Sides of their box.
    periodic : bool
        Whether its opposite sides are glued together.
    report : dict
        How the run went: candidates, disks, windows, rho, bytes and seconds.

    Raises
    ------
    InvalidArgument, TypeError
        For arrays of another kind or shape, and numbers that are not finite.

    Notes
    -----
    Samples of a mesh refer to its arrays, so that :func:`verify`, :func:`render` and
    :func:`transfer` need not be given them again. Files do not have them.

    Examples
    --------
    >>> import geodisk
    >>> corner = geodisk.Samples([[0, 0, 0]], face_index=[0], barycentric=[[1, 0, 0]])
    >>> len(corner)
    1
    """

    points: NDArray[np.float64] | None = None
    normals: NDArray[np.float64] | None = None
    face_index: NDArray[np.uint32] | None = None
    barycentric: NDArray[np.float64] | None = None
    radius: NDArray[np.float64] = None  # type: ignore[assignment]  # Until __post_init__().
    order: NDArray[np.int64] = None  # type: ignore[assignment]
    min_distance: float = math.nan
    seed: int | None = None
    extents: tuple[float, ...] | None = None
    periodic: bool = False
    report: dict[str, Any] = field(default_factory=dict)
    _surface: Surface | None = None

    def __post_init__(self) -> None:
        def keep(name: str, value: Any) -> None:
            object.__setattr__(self, name, value)

        some = self.points if self.points is not None else self.face_index
        if some is None or (self.face_index is None) != (self.barycentric is None):
            raise e.invalid("samples have points, or face_index and barycentric, or all of them")
        n = len(some)
        if self.points is not None:
            shape = np.shape(self.points)
            if len(shape) != 2 or not 1 <= shape[1] <= 8:
                raise e.invalid(f"points have the shape {shape}, not (n, 1) to (n, 8)")
            keep("points", _table(self.points, "points", (n, shape[1])))
        if self.normals is not None:
            keep("normals", _table(self.normals, "normals", (n, 3)))
        if self.face_index is not None and self.barycentric is not None:
            faces = indices(self.face_index, "face_index").astype(np.uint32, copy=False)
            if faces.shape != (n,):
                raise e.invalid(f"face_index have the shape {faces.shape}, not {(n,)}")
            keep("face_index", faces)
            keep("barycentric", _table(self.barycentric, "barycentric", (n, 3)))
        distance = float(self.min_distance)
        if distance < 0 or math.isinf(distance):
            raise e.invalid(f"the minimum distance is {distance}, not positive")
        keep("min_distance", distance)
        if self.radius is None or np.isnan(self.radius).all():
            keep("radius", np.full(n, distance / 2))
        else:
            keep("radius", _table(self.radius, "radius", (n,)))
            if (self.radius < 0).any():
                raise e.invalid(f"a radius is {self.radius.min()}, not positive")
        order = np.arange(n) if self.order is None else np.asarray(self.order, np.int64)
        if order.shape != (n,):
            raise e.invalid(f"order has the shape {order.shape}, not {(n,)}")
        keep("order", order)
        if self.extents is not None:
            sides = tuple(float(side) for side in self.extents)
            if not all(side > 0 and math.isfinite(side) for side in sides):
                raise e.invalid(f"extents are {sides}, not all positive")
            if self.points is None or self.points.shape[1] != len(sides):
                raise e.invalid(f"extents are {len(sides)} sides, not one for each coordinate")
            keep("extents", sides)

    def __len__(self) -> int:
        return len(self.radius)

    def __repr__(self) -> str:
        seed = "" if self.seed is None else f", seed {self.seed}"
        return f"<geodisk.Samples: {len(self)}, {self.min_distance:.6g} apart{seed}>"

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the samples to a file, which is complete or not there.

        Parameters
        ----------
        path : str or path-like
            ``*.npz`` for ``numpy.load``, ``*.csv``, or ``*.ply`` for viewers. :func:`read` reads
            all of them, ``geodisk verify`` and the other commands CSV and PLY.

        Raises
        ------
        ValueError
            For another kind of file.
        OSError
            Where it cannot be written.
        """
        path = os.fspath(path)
        writers = {".npz": write_npz, ".csv": write_csv, ".ply": write_ply}
        write = writers.get(os.path.splitext(path)[1].lower())
        if write is None:
            raise e.invalid(f"{path}: samples are saved as *.npz, *.csv or *.ply")
        with complete(path) as file:
            write(file, self, header_of(self))


def _copied(samples: ctypes.c_void_p, attribute: int, dtype: Any) -> NDArray[Any] | None:
    width = c.samples_width(samples, attribute)
    if width == 0:
        return None
    count = c.samples_count(samples)
    array = np.empty((count, width), dtype)
    kind = s.UINT32 if dtype == np.uint32 else s.FLOAT64
    c.call("geodisk_samples_copy", samples, attribute, kind, array.ctypes.data, 0, count)
    return array


def samples_of(handle: c.Handle, seed: int, **domain: Any) -> Samples:
    """What a run gave, in a `domain`: the extents of a box, or the surface."""
    samples = handle.value
    report = s.Report()
    c.call("geodisk_samples_report", samples, ctypes.byref(report))
    told = {
        name: getattr(report, name)
        for name, _ in s.Report._fields_
        if name not in ("struct_size", "calls")
    }
    face = _copied(samples, s.FACE, np.uint32)
    radius = _copied(samples, s.RADIUS, np.float64)
    assert radius is not None
    return Samples(
        points=_copied(samples, s.POSITION, np.float64),
        normals=_copied(samples, s.NORMAL, np.float64),
        face_index=None if face is None else face[:, 0],
        barycentric=_copied(samples, s.BARYCENTRIC, np.float64),
        radius=radius[:, 0],
        min_distance=report.min_distance,
        seed=seed,
        report=told,
        **domain,
    )
