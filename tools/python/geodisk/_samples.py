"""The result of a run."""

from __future__ import annotations

import copy
import dataclasses
import math
import os
import reprlib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Iterator, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from ._arrays import array_of, indices, real
from ._attributes import check_finite, interpolated, values_of
from ._conversion import converted
from ._files import complete
from ._job import Job, JobFrame
from ._surface import Surface
from ._values import choice, flag, integer, number, numbers_of, path_of
from ._writing import (
    OTHER_FORMATS,
    WHOLE_COLUMNS,
    bytes_as,
    check_names,
    columns_of,
    digest_of,
    header_of,
    write_csv,
    write_npz,
    write_ply,
)

if TYPE_CHECKING:
    import pandas

    from ._mesh import Mesh
    from ._record import Record

@dataclass(frozen=True, eq=False)
class Sample:
    """One sample of :class:`Samples`, which iteration and an index give.

    Attributes
    ----------
    point, normal, barycentric : ndarray of float64, or None
    face_index, polygon_index : int or None
    radius : float
    order : int
    columns : dict of int
    attributes : dict of float, int or ndarray
    """

    point: NDArray[np.float64] | None
    normal: NDArray[np.float64] | None
    face_index: int | None
    barycentric: NDArray[np.float64] | None
    polygon_index: int | None
    radius: float
    order: int
    columns: dict[str, int] = field(default_factory=dict)
    attributes: dict[str, Any] = field(default_factory=dict)


_COLUMNS = tuple("points normals face_index barycentric polygon_index radius order".split())


def _table(values: ArrayLike, name: str, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """As float64 of that shape, all finite."""
    array = real(values, name).astype(np.float64, copy=False)
    if array.shape != shape:
        raise e.invalid(f"{name} have the shape {array.shape}, not {shape}")
    if not np.isfinite(array).all():
        place = np.argwhere(~np.isfinite(array))[0]
        raise e.invalid(f"{name}[{', '.join(map(str, place))}] is {array[tuple(place)]}")
    return array


def _indices(values: ArrayLike, name: str, n: int, dtype: Any = np.uint32) -> NDArray[Any]:
    """Whole numbers, one for each of n samples."""
    array = indices(values, name).astype(dtype, copy=False)
    if array.shape != (n,):
        has = "have" if name == "face_index" else "has"
        raise e.invalid(f"{name} {has} the shape {array.shape}, not {(n,)}")
    return array


def _column(values: ArrayLike, name: str, n: int) -> NDArray[np.uint32]:
    """As uint32, one for each of n samples."""
    if name not in WHOLE_COLUMNS:
        raise e.invalid(f"columns: {name!r} is none of {', '.join(WHOLE_COLUMNS)}")
    return _indices(values, name, n)


def _lengths(values: Any, name: str) -> tuple[float, ...]:
    """Finite numbers above 0."""
    lengths = numbers_of(values, name)
    if not all(length > 0 and math.isfinite(length) for length in lengths):
        raise e.invalid(f"{name} are {lengths}, not all positive")
    return lengths


def _attribute(values: ArrayLike, name: str, n: int) -> NDArray[Any]:
    """As int32 or float64, one or several numbers for each of n samples."""
    if not isinstance(name, str) or not name:
        raise TypeError(f"the name of an attribute is {name!r}, not a text")
    array = array_of(values, f"the attribute {name!r}")
    if array.dtype.kind not in "biuf":
        raise TypeError(f"the attribute {name!r} has to be of numbers, not of {array.dtype}")
    if array.ndim not in (1, 2) or len(array) != n:
        raise e.invalid(
            f"the attribute {name!r} has the shape {array.shape}, not ({n},) or ({n}, k)"
        )
    if array.dtype.kind == "f":
        return array.astype(np.float64, copy=False)
    least, most = (int(array.min()), int(array.max())) if array.size > 0 else (0, 0)
    if max(-least, most) > 2**53:
        raise e.invalid(f"the attribute {name!r} has integers above 2^53, which float64 cannot hold")
    return array.astype(np.int32 if -(2**31) < least and most < 2**31 else np.float64, copy=False)


@dataclass(frozen=True, eq=False, repr=False)
class Samples:
    """Samples in dart order: the first n of them are the set of a run with ``stop_count=n``.

    :func:`sample`, :func:`sample_box`, :func:`transfer` and :func:`read` return them. For samples of
    other programs, make them from arrays, to verify or draw them.

    Attributes
    ----------
    points : ndarray of float64, shape (n, d) or None
        Coordinates; None on a mesh of edge lengths.
    normals : ndarray of float64, shape (n, 3) or None
        Normals on meshes in three dimensions: of the triangles, unless others were asked for.
    face_index : ndarray of uint32, shape (n,) or None
        Triangles on meshes: rows of ``Mesh.triangles``.
    barycentric : ndarray of float64, shape (n, 3) or None
        Weights of the triangles' corners. They sum to 1.
    radius : ndarray of float64, shape (n,)
        Half the minimum distance, or the radius of each sample if radii vary. With classes, half the
        distance of two samples of its class.
    order : ndarray of int64, shape (n,)
        Positions in dart order.
    min_distance : float
        Minimum distance along the surface; if radii vary, of two samples with the largest radius.
        NaN if unknown.
    seed : int or None
    extents : tuple of float or None
        Sides of the box.
    periodic : bool
        True if its opposite sides are glued together.
    report : dict
        Report of the run: candidates, disks, windows, rho, bytes and seconds. ``"options"`` names
        the arguments that chose these samples, besides seed and distance.
    polygon_index : ndarray of uint32, shape (n,) or None
        Numbers of the given faces, if polygons were split into triangles.
    columns : dict of ndarray of uint32, shape (n,)
        Numbers that the triangles have in a file, as requested from :class:`Mesh`. ``"existing"``
        is 1 for existing samples that a run kept, else 0. ``"class"`` is the class of each sample,
        ``"level"`` its level in progressive order. ``"feature"`` is 2 on a corner, 1 on a curve, 0
        on a face. ``"vertex"`` is `vertices`.
    attributes : dict of ndarray, shape (n,) or (n, k)
        Attributes of the mesh file at the samples, as requested from :class:`Mesh`: numbers by the
        weights of corners, integers of the corner with the largest weight.
    class_distances : ndarray of float64, shape (k, k) or None
        Minimum distances of the pairs of classes; None if samples have no classes.
    level_distances : tuple of float, or None
        Minimum distances of the levels of progressive order, the largest first.

    Raises
    ------
    InvalidArgument, TypeError
        For arrays of a wrong type or shape, and numbers that are not finite.

    Notes
    -----
    Samples of a mesh refer to its arrays, so :func:`verify`, :func:`render` and :func:`transfer` do
    not need them again. Files and pickles do not contain them.

    ``samples[3]`` is a :class:`Sample`, and iteration yields each of them. Slices, masks and lists
    of indices give Samples with all data of the selected ones.

    Examples
    --------
    >>> import geodisk
    >>> corner = geodisk.Samples([[0, 0, 0]], face_index=[0], barycentric=[[1, 0, 0]])
    >>> len(corner), corner[0].face_index
    (1, 0)
    >>> square = geodisk.sample_box([1, 1], min_distance=0.1)
    >>> left = square[square.points[:, 0] < 0.5]
    >>> len(left) < len(square), len(square[:10])
    (True, 10)
    """

    points: NDArray[np.float64] = None  # type: ignore[assignment]  # None without coordinates.
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
    polygon_index: NDArray[np.uint32] | None = None
    columns: dict[str, NDArray[np.uint32]] = field(default_factory=dict)
    attributes: dict[str, NDArray[Any]] = field(default_factory=dict)
    class_distances: NDArray[np.float64] | None = None
    level_distances: tuple[float, ...] | None = None
    _surface: Surface | None = None
    _digest: str | None = None  # Of the set that these are of, if these may be a part.
    _job: Job | None = None  # What they were made with, for updates.
    _told: dict[str, str] = field(default_factory=dict)  # Entries of headers in values().
    _record: Record | None = None  # What they have of their mesh; None if that is unknown.
    #: Frame in which they were decided; None for that of a run over their mesh at `min_distance`.
    _frame: JobFrame | None = None

    def __post_init__(self) -> None:
        def keep(name: str, value: Any) -> None:
            object.__setattr__(self, name, value)

        some = self.points if self.points is not None else self.face_index
        if some is None or (self.face_index is None) != (self.barycentric is None):
            raise e.invalid("samples have points, or face_index and barycentric, or all of them")
        for name in ("columns", "attributes", "report"):
            if not isinstance(getattr(self, name), dict):
                raise TypeError(f"{name} is {getattr(self, name)!r}, not a dict")
        name = "face_index" if self.points is None else "points"
        shape = array_of(some, name).shape
        if len(shape) == 0:
            raise e.invalid(f"{name} is a single number, not an array")
        n = shape[0]
        if self.points is not None:
            if len(shape) != 2 or not 1 <= shape[1] <= 8:
                raise e.invalid(f"points have the shape {shape}, not (n, 1) to (n, 8)")
            keep("points", _table(self.points, "points", (n, shape[1])))
        if self.normals is not None:
            keep("normals", _table(self.normals, "normals", (n, 3)))
        if self.face_index is not None and self.barycentric is not None:
            keep("face_index", _indices(self.face_index, "face_index", n))
            keep("barycentric", _table(self.barycentric, "barycentric", (n, 3)))
        if self.polygon_index is not None:
            keep("polygon_index", _indices(self.polygon_index, "polygon_index", n))
        keep("columns", {name: _column(x, name, n) for name, x in self.columns.items()})
        keep("attributes", {name: _attribute(x, name, n) for name, x in self.attributes.items()})
        distance = number(self.min_distance, "min_distance")
        if distance < 0 or math.isinf(distance):
            raise e.invalid(f"the minimum distance is {distance}, not positive")
        keep("min_distance", distance)
        radii = real(math.nan if self.radius is None else self.radius, "radius")
        if radii.shape in ((), (n,)) and np.isnan(radii).all():
            keep("radius", self._radii_of_classes(n))
        else:
            keep("radius", _table(self.radius, "radius", (n,)))
            if (self.radius < 0).any():
                raise e.invalid(f"a radius is {self.radius.min()}, not positive")
        order = np.arange(n) if self.order is None else self.order
        keep("order", _indices(order, "order", n, np.int64))
        if self.level_distances is not None:
            keep("level_distances", _lengths(self.level_distances, "level_distances"))
        if self.seed is not None:
            keep("seed", integer(self.seed, "seed", 2**64 - 1))
        keep("periodic", flag(self.periodic, "periodic"))
        if self.class_distances is not None:
            table = array_of(self.class_distances, "class_distances")
            k = len(table) if table.ndim == 2 else 0
            keep("class_distances", _table(table, "class_distances", (k, k)))
        if self.extents is not None:
            sides = _lengths(self.extents, "extents")
            if self.points is None or self.points.shape[1] != len(sides):
                raise e.invalid(f"extents are {len(sides)} sides, not one for each coordinate")
            keep("extents", sides)

    def _radii_of_classes(self, n: int) -> NDArray[np.float64]:
        """Half the distance of each sample's class, or half the minimum distance without classes."""
        classes, table = self.columns.get("class"), self.class_distances
        if classes is None or table is None or (n > 0 and classes.max() >= len(table)):
            return np.full(n, self.min_distance / 2)
        own = np.diag(np.asarray(table, np.float64)) / 2
        return np.ascontiguousarray(own[classes], np.float64)

    @property
    def classes(self) -> NDArray[np.uint32] | None:
        """Class of each sample, ``columns["class"]``; None if samples have no classes."""
        return self.columns.get("class")

    @property
    def vertices(self) -> NDArray[np.uint32] | None:
        """Vertex of each sample, ``columns["vertex"]``; None unless samples are `at_vertices`.

        4294967295 for existing samples that are at none.
        """
        return self.columns.get("vertex")

    def __len__(self) -> int:
        return len(self.radius)

    @property
    def level(self) -> NDArray[np.uint32] | None:
        """Level of each sample in progressive order, from 0; None in dart order."""
        return self.columns.get("level")

    @overload
    def __getitem__(self, key: int | np.integer[Any]) -> Sample: ...
    @overload
    def __getitem__(
        self, key: slice | NDArray[Any] | list[int] | list[bool]
    ) -> Samples: ...
    def __getitem__(self, key: Any) -> Sample | Samples:
        if isinstance(key, (int, np.integer)) and not isinstance(key, bool):
            if not -len(self) <= key < len(self):
                raise IndexError(f"sample {key} of {len(self)}")
            return self._sample(int(key) % len(self))
        if not isinstance(key, slice):
            try:
                key = np.asarray(key)
            except ValueError:
                key = np.empty((0, 0))
            if key.ndim != 1 or (key.dtype.kind not in "iub" and key.size > 0):
                raise IndexError("samples are chosen by an index, a slice, a mask or indices")
            key = key if key.size > 0 else key.astype(np.int64)
        columns = {name: getattr(self, name) for name in _COLUMNS}
        chosen: dict[str, Any] = {
            name: None if x is None else x[key] for name, x in columns.items()
        }
        for name, checked in (("columns", _column), ("attributes", _attribute)):
            own = getattr(self, name).items()
            chosen[name] = {one: checked(x, one, len(self))[key] for one, x in own}
        return dataclasses.replace(self, **chosen, _digest=self._digest_of_set())

    def __iter__(self) -> Iterator[Sample]:
        return (self._sample(i) for i in range(len(self)))

    def _digest_of_set(self) -> str | None:
        """Digest of the set that these are of, all of it unless chosen by an index."""
        if self._digest is None and self.face_index is not None and self.barycentric is not None:
            object.__setattr__(self, "_digest", digest_of(self.face_index, self.barycentric))
        return self._digest

    def _is_whole(self) -> bool:
        """Whether these are all of their set, in any order."""
        faces, weights = self.face_index, self.barycentric
        if self.report.get("samples", len(self)) != len(self):
            return False
        return self._digest is None or (
            faces is not None and weights is not None and self._digest == digest_of(faces, weights)
        )

    def _checked(self) -> Samples:
        """Returns the samples; raises if what was assigned to their dicts and arrays does not fit."""
        samples = dataclasses.replace(self)
        check_names(samples.attributes)
        return samples

    def _sample(self, i: int) -> Sample:
        def row(array: NDArray[Any] | None) -> Any:
            return None if array is None else array[i]

        def number(array: NDArray[Any] | None) -> int | None:
            return None if array is None else int(array[i])

        return Sample(
            point=row(self.points),
            normal=row(self.normals),
            face_index=number(self.face_index),
            barycentric=row(self.barycentric),
            polygon_index=number(self.polygon_index),
            radius=float(self.radius[i]),
            order=int(self.order[i]),
            columns={name: int(x[i]) for name, x in self.columns.items()},
            attributes={name: x[i] for name, x in self.attributes.items()},
        )

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_surface": None, "_job": None}  # Often much larger.

    def __copy__(self) -> Samples:
        return dataclasses.replace(self)

    def __deepcopy__(self, memo: dict[int, Any]) -> Samples:
        own = {name: copy.deepcopy(x, memo) for name, x in self.__getstate__().items()}
        return dataclasses.replace(self, **{**own, "_surface": self._surface, "_job": self._job})

    def __repr__(self) -> str:
        seed = "" if self.seed is None else f", seed {self.seed}"
        return f"<geodisk.Samples: {len(self)}, {self.min_distance:.6g} apart{seed}>"

    def interpolate(
        self,
        values: ArrayLike,
        *,
        of: str = "vertices",
        nearest: bool | None = None,
        mesh: Mesh | None = None,
    ) -> NDArray[Any]:
        """Returns values of the mesh at the samples.

        Parameters
        ----------
        values : array_like, shape (v, ...), (f, 3, ...) or (f, ...)
            Values of the vertices, of the corners of each triangle, or of the faces: numbers,
            colours, vectors or labels.
        of : {"vertices", "corners", "faces"}
            What has the values. Faces are triangles, or the given polygons.
        nearest : bool, optional
            True to take the value of the corner with the largest weight, False to interpolate by
            the weights. By default, floats are interpolated; integers, booleans and text are not.
        mesh : Mesh, optional
            The mesh of samples that do not refer to it, as those from files.

        Returns
        -------
        ndarray, shape (n, ...)

        Raises
        ------
        InvalidArgument
            For values of another length, or values at a sample that are not finite.

        Examples
        --------
        >>> import geodisk
        >>> mesh = geodisk.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> samples = geodisk.sample(mesh, min_distance=0.2)
        >>> bool(abs(samples.interpolate(mesh.vertices) - samples.points).max() < 1e-6)
        True
        >>> sorted(set(samples.interpolate(["a", "b", "c"]).tolist()))
        ['a', 'b', 'c']
        """
        if mesh is not None and not hasattr(mesh, "_surface"):
            raise TypeError(f"mesh is {reprlib.repr(mesh)}, not a geodisk.Mesh")
        choice(of, "of", ("vertices", "corners", "faces"))
        surface = self._surface if mesh is None else mesh._surface
        faces, weights = self.face_index, self.barycentric
        if faces is None or weights is None:
            raise e.invalid("samples in a box lie on no mesh")
        if surface is None:
            raise e.invalid("these samples do not refer to their mesh; give mesh=")
        sums = weights.sum(axis=1)
        if len(faces) and not (np.abs(sums - 1) < 1e-3).all():
            row = int(np.argmax(~(np.abs(sums - 1) < 1e-3)))
            raise e.invalid(f"sample {row} has the weights {weights[row]}, which do not sum to 1")
        corners = surface.own_corners()
        if len(faces) and int(faces.max()) >= len(corners):
            raise e.invalid(f"a sample lies in triangle {faces.max()}, the mesh has {len(corners)}")
        values = array_of(values, "values")
        if of == "faces":
            own = surface.by_triangle(values)
            count = len(corners) if own.shape[:1] == (len(corners),) else surface.face_count()
            return np.asarray(values_of(own, count, "faces")[faces])
        if of == "vertices":
            count = surface.own_vertex_count()
            if values.shape[:1] == (surface.vertex_count(),):  # With those of copies.
                values = values[:count]
            found = values_of(values, count, "vertices")[corners[faces]]
        else:
            array = values_of(values, len(corners), "triangles")
            if array.ndim < 2 or array.shape[1] != 3:
                raise e.invalid(f"values of corners have the shape {array.shape}, not (f, 3, ...)")
            found = array[faces]
        check_finite(found, faces)
        is_nearest = found.dtype.kind != "f" if nearest is None else flag(nearest, "nearest")
        if not is_nearest and found.dtype.kind in "SU":
            raise TypeError("text cannot be interpolated; give nearest=True")
        return interpolated(found, weights, is_nearest)

    def to(self, kind: str) -> Any:
        """Returns the samples as arrays or an object of another package.

        All have points, normals, `face_index`, `barycentric`, `polygon_index`, `radius`, `order`,
        and what ``columns`` and ``attributes`` have, by name, if they exist.

        Parameters
        ----------
        kind : {"numpy", "torch", "dlpack", "pyvista", "trimesh", "open3d"}
            "numpy" is a dict of the arrays themselves. "torch" is a dict of tensors, and "dlpack" one
            of arrays for the ``from_dlpack`` of any package: copies, with indices as int64.
            "pyvista" is a ``PolyData`` of points with ``point_data``. "trimesh" is a ``PointCloud``
            with ``colors``, and the others in ``metadata``. "open3d" is a
            ``t.geometry.PointCloud`` with all in ``point``.

        Raises
        ------
        ImportError
            If the package is not installed.
        InvalidArgument
            For another kind, or for points of more than three coordinates in a package for space.

        Notes
        -----
        Points of fewer coordinates get 0 for the others in PyVista, trimesh and Open3D. The
        attribute ``color`` becomes bytes in PyVista and trimesh, and ``colors`` in Open3D.

        Examples
        --------
        >>> import geodisk
        >>> arrays = geodisk.sample_box([1, 1], min_distance=0.1).to("numpy")
        >>> list(arrays)
        ['points', 'radius', 'order']
        """
        samples = self._checked()
        own = {name: getattr(samples, name) for name in _COLUMNS}
        arrays = {**own, **samples.columns, **samples.attributes}
        return converted({name: x for name, x in arrays.items() if x is not None}, kind)

    def to_dataframe(self) -> pandas.DataFrame:
        """Returns a pandas table with the columns of sample files.

        Returns
        -------
        pandas.DataFrame
            x, y, z (or x0, x1 ... in more dimensions), nx, ny, nz, face_index, bary_u, bary_v,
            bary_w, polygon_index, those of ``columns`` and ``attributes``, radius and order, if
            they exist.
            ``attrs`` has the minimum distance, the seed and so on.

        Raises
        ------
        ImportError
            If pandas is not installed.
        """
        try:
            import pandas
        except ImportError:
            raise ImportError("to_dataframe() needs pandas (pip install pandas)") from None
        samples = self._checked()
        columns = {**columns_of(samples, as_box=True), "radius": self.radius, "order": self.order}
        table = pandas.DataFrame({name: column.copy() for name, column in columns.items()})
        table.attrs.update(header_of(samples))
        return table

    def save(self, path: str | os.PathLike[str], *, pixel_size: float | None = None) -> None:
        """Writes the samples to a file, completely or not at all.

        An existing file is replaced after everything is written. Links are followed, and the file
        keeps its permissions. Any number of threads and processes may save to the same path.

        Parameters
        ----------
        path : str or path-like
            ``*.npz`` for ``numpy.load``, ``*.csv``, or ``*.ply`` for viewers, which :func:`read`
            reads. Also ``*.pcd``, ``*.obj`` and ``*.xyz`` for point clouds, ``*.vtp`` for VTK,
            ``*.glb``, ``*.gltf`` and ``*.usda`` for scenes, and ``*.star`` for RELION, as the
            program writes them. ``geodisk verify`` and the other commands read all but those for
            scenes and RELION; of ``*.obj`` and ``*.xyz`` the points.
        pixel_size : float, optional
            Divide coordinates by this pixel size in ``*.star``. The mesh is in angstroms then. By
            default it is in pixels.

        Raises
        ------
        ValueError
            For another file extension, and for attributes and columns that do not fit the samples,
            or have the name of another one.
        OSError
            Where it cannot be written. What was there is kept.

        Notes
        -----
        In CSV and PLY files a "_" replaces each character of the names of attributes that is no
        letter, digit, "_", "." or "-".
        """
        path = path_of(path)
        suffix = os.path.splitext(path)[1].lower()
        samples = self._checked()
        if pixel_size is not None:
            if suffix != ".star":
                raise e.invalid("pixel_size is for samples in *.star")
            pixel_size = number(pixel_size, "pixel_size")
            if not (math.isfinite(pixel_size) and pixel_size > 0):
                raise e.invalid(f"pixel_size is {pixel_size}, not a positive number")
        writers = {".npz": write_npz, ".csv": write_csv, ".ply": write_ply}
        if suffix in writers:
            with complete(path) as file:
                writers[suffix](file, samples, header_of(samples))
        elif suffix in OTHER_FORMATS:
            written = bytes_as(suffix, samples, pixel_size)
            with complete(path) as file:
                file.write(written)
        else:
            known = ", ".join(f"*{name}" for name in (*writers, *OTHER_FORMATS))
            raise e.invalid(f"{path}: samples are saved as one of {known}")

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        """Returns the points, for numpy and what takes arrays."""
        if self.points is None:
            raise e.invalid("samples on a mesh of edge lengths have no points")
        if copy:
            return np.array(self.points, dtype)
        return np.asarray(self.points, dtype)
