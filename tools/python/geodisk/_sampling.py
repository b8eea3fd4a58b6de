"""Sampling meshes: the functions, their parameters, and what these mean."""

from __future__ import annotations

import numbers
import os
from typing import Any, Iterable, Mapping, Sequence

from numpy.typing import ArrayLike

from ._classes import ClassesLike
from ._devices import DeviceLike
from ._existing import AvoidLike, ExistingLike
from ._protocols import Faces, MeshLike
from ._running import ProgressCallback
from ._samples import Samples
from ._wanted import sample_each, sample_one


def sample(
    vertices: ArrayLike | MeshLike,
    faces: Faces | None = None,
    *,
    min_distance: float | None = None,
    radius: float | None = None,
    count: float | None = None,
    exact: bool = False,
    seed: int | None = 0,
    density: ArrayLike | None = None,
    radius_factor: ArrayLike | None = None,
    pool_ratio: float = 20,
    darts: int = 0,
    stop_count: int = 0,
    maximal: bool = False,
    order: str = "dart",
    levels: int | None = None,
    level_factor: float | None = None,
    face_keys: ArrayLike | None = None,
    face_mask: ArrayLike | None = None,
    existing: ExistingLike | None = None,
    avoid: AvoidLike | None = None,
    classes: ClassesLike | None = None,
    class_counts: Sequence[int] | None = None,
    class_masks: Mapping[int, ArrayLike] | None = None,
    class_densities: Mapping[int, ArrayLike] | None = None,
    class_avoid: Mapping[int, AvoidLike] | None = None,
    features: float | None = None,
    at_vertices: bool = False,
    metric: str = "geodesic",
    edge_lengths: ArrayLike | None = None,
    weld: bool | float = False,
    keep_seams: bool = False,
    columns: str | Sequence[str] = (),
    attributes: str | Sequence[str] = (),
    texture: str | os.PathLike[str] | None = None,
    normals: str = "face",
    frames: bool | float | str = False,
    up: str | None = None,
    mesh_format: str | None = None,
    allow_outside: bool = False,
    device: DeviceLike | None = None,
    progress: bool | ProgressCallback = False,
) -> Samples:
    """Returns random points on a mesh, no two closer than a minimum distance along the surface.

    Parameters
    ----------
    vertices : array_like of float, shape (v, d), or a mesh
        Coordinates; or a mesh with faces: a :class:`Mesh`, the path of a file, or an object of
        another package that :class:`Mesh` accepts.
    faces : array_like of int, shape (f, 3) or (f, k), or sequence of sequences
        Triangles or polygons.
    min_distance, radius, count : float
        Give one: the minimum distance along the surface, in the unit of the vertices; half of it;
        or the approximate number of samples, for which a distance is found.
    exact : bool
        Return exactly `count` samples: the first ones of a run that has up to 1 % more. The search
        for its distance takes 1 to 6 runs, at most 12.
    seed : int or None
        A 64-bit number. Equal seeds give equal samples, on every device. None for a random one, which
        ``samples.seed`` tells.
    density : array_like of float, shape (v,), (f,) or (f, 3), or str, optional
        Density of samples at each vertex, in any unit; 0 for none. The distance applies where the
        density is largest. Values of faces or of their corners become means at the vertices; of
        faces, weighted by area. With as many faces as vertices, values are those of vertices. A
        name is that of an attribute of the mesh, or of a component, as "red"; it is read if the mesh is
        a file or an object of another package.
    radius_factor : array_like of float, shape (v,), (f,) or (f, 3), or str, optional
        Factor of the radius at each vertex, 0.001 to 1, given as a density. The distance applies
        to two samples with factor 1.
    pool_ratio : float
        Candidates per expected sample, 1 to 10,000. More candidates leave fewer gaps: 100 give a
        packing density of 0.75 instead of 0.72.
    darts : int
        Number of darts to throw, instead of a pool by `pool_ratio`.
    stop_count : int
        Stop after this many samples. A warning reports if fewer fit.
    maximal : bool
        True to go on after the pool until no further sample fits anywhere. The report then has
        ``is_certified`` 1 if every point is nearer to a sample than ``largest_gap``. Not with
        `darts`, `stop_count`, `density` and other metrics.
    order : {"dart", "progressive", "farthest"}
        "progressive" returns samples in levels, coarse to fine: each level has half the distance of
        the one before, and the last one the given distance. The samples up to the end of a level
        are spaced by its distance. ``samples.level`` has the level of each, and
        ``samples.level_distances`` their distances.
        "farthest" puts samples in farthest-point order after `existing` ones, see
        :func:`farthest_order`;
        ``samples.attributes["cover"]`` has the distance of each to the nearest before it, and ``["row"]`` its place in dart order.
    levels : int, optional
        Number of levels, 1 to 32. By default the first one has 16 samples or somewhat more.
    level_factor : float, optional
        Distance of a level, divided by that of the next: 2, or 1.1 to 8.
    face_keys : array_like of int, shape (f,), optional
        One key per triangle, all different, by which its candidates are drawn: a triangle with the
        same key has the same candidates in every mesh.
    face_mask : array_like of bool, shape (f,), or of int, optional
        True for each triangle, or each given polygon, that takes samples; or the indices of these
        triangles. Paths cross the others all the same.
    existing : Samples, or a pair of face_index and barycentric, optional
        Samples of the mesh to keep: the first of the result, with a 1 in ``columns["existing"]``.
        Samples without `face_index` are put on the nearest triangles, at most a thousandth of the
        bounding-box diagonal away. New ones keep the minimum distance from them. They count towards
        `count` and `stop_count`. Distances among them are not checked; :func:`verify` tells them
        apart.
    avoid : pair of points and radius, optional
        Points to keep away from, as for `existing`, and their radius or radii along the surface.
        No new sample is within the radius of its point, which may be larger or smaller than the
        minimum distance.
    classes : int or array_like of float, shape (k, k), optional
        Number of classes of samples, 1 to 8, each with the minimum distance D, where samples of
        two classes are D / sqrt(k) apart. Or a symmetric table of the distances of all pairs of
        classes, in place of the minimum distance, 0 for two classes that keep none; with `count`,
        it is scaled. ``columns["class"]`` has the classes.
    class_counts : sequence of int, optional
        Number of samples of each class: the first ones of each. A warning reports if fewer fit. Not
        with `count` and `stop_count`.
    class_masks : dict from int to what `face_mask` takes, optional
        Triangles on which samples of single classes may lie, by the number of the class: ``{0: mask}``.
    class_densities : dict from int to what `density` takes, optional
        Densities of single classes, as parts of the largest value: where it is half of that, the class
        has about half of the samples that fit there, and none where it is 0.
    class_avoid : dict from int to what `avoid` takes, optional
        Points that single classes keep away from.
    features : float, optional
        Sample corners first, then edges whose triangles meet at more than this angle in degrees (1
        to 180), borders and edges of more than two triangles, then the triangles.
        ``columns["feature"]`` is 2, 1 and 0.
    at_vertices : bool
        Sample at vertices alone: each is a candidate, drawn by its share of the area. ``vertices`` of
        the samples are their indices. `pool_ratio` has no effect.
    metric : {"geodesic", "euclidean", "approximate"}
        Distance to use; the last two are for comparison, on meshes without walls.
    edge_lengths, weld, keep_seams, columns, attributes, mesh_format, allow_outside
        Parameters of :class:`Mesh`.
    texture : str or path-like, optional
        PNG, JPEG, WebP, TGA or BMP image whose colours to add, as ``attributes["color"]``, at
        the texture coordinates that the mesh file has. "auto" adds those of the materials of a
        glTF or OBJ file and their images. Colours are from 0 to 1, as sRGB encodes them.
    normals : {"face", "file", "smooth"}
        Normals of triangles, those of the mesh file, or interpolated means at vertices.
    frames : bool, float or str
        Add ``attributes["frames"]``, shape (n, 4): quaternions (x, y, z, w) that turn z to the
        normal, after a random angle about z. "y" turns y, for models whose y points up. "upright"
        keeps models upright, and 0.3 turns them 0.3 of the way from there to the normal. "y,0.3"
        is both.
    up : {"x", "y", "z"}, optional
        Axis of the mesh that points up, for frames that are upright or turned a part of the way. By
        default y for a file of glTF, else z.
    device : Device, int or str, optional
        One of :func:`devices`, its index, its UUID or a part of its name. The default is the
        environment variable GEODISK_DEVICE, else the best device.
    progress : bool or callable
        True for a progress bar by tqdm, or a line on standard error without it. A function is called
        about ten times per second with the part that is done, 0 to 1, and the number of samples so
        far. If it returns False, the run stops with :class:`Cancelled`. If it raises an exception, the
        run stops with it.

    Returns
    -------
    Samples

    Raises
    ------
    MeshRejected
        For a mesh that cannot be sampled; ``element`` is the face or vertex.
    InvalidArgument, TypeError
        For values out of range, and arrays of a wrong type or shape.
    NoDevice, OutOfMemory, DeviceLost
        If the device fails.
    Cancelled
        If the progress callback returns False.
    KeyboardInterrupt
        Ctrl-C ends a run at once.

    Warns
    -----
    MeshWarning
        As :class:`Mesh` does.
    GeodiskWarning
        For a number of samples that differs from the count, no room beside `existing` and `avoid`,
        parts of the area without samples, and a distance that leaves one sample per part.

    Examples
    --------
    >>> import geodisk
    >>> corners = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]
    >>> tetrahedron = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]
    >>> samples = geodisk.sample(corners, tetrahedron, min_distance=0.2, seed=7)
    >>> samples.points.shape
    (213, 3)
    >>> bool(samples.face_index.max() < 4)
    True
    """
    given = dict(locals())
    if isinstance(faces, numbers.Real):
        raise TypeError(f"faces is {faces!r}; for about so many samples give count={faces!r}")
    return sample_one(given)


def sample_many(
    meshes: Iterable[MeshLike | tuple[ArrayLike, Any]],
    *,
    min_distance: float | Sequence[float] | None = None,
    radius: float | Sequence[float] | None = None,
    count: float | Sequence[float] | None = None,
    exact: bool = False,
    seed: int | None | Sequence[int | None] = 0,
    density: Sequence[ArrayLike | None] | None = None,
    radius_factor: Sequence[ArrayLike | None] | None = None,
    face_keys: Sequence[ArrayLike | None] | None = None,
    face_mask: Sequence[ArrayLike | None] | None = None,
    existing: Sequence[ExistingLike | None] | None = None,
    avoid: Sequence[AvoidLike | None] | None = None,
    pool_ratio: float = 20,
    darts: int = 0,
    stop_count: int = 0,
    maximal: bool = False,
    order: str = "dart",
    levels: int | None = None,
    level_factor: float | None = None,
    classes: ClassesLike | None = None,
    class_counts: Sequence[int] | None = None,
    class_masks: Sequence[Mapping[int, ArrayLike] | None] | None = None,
    class_densities: Sequence[Mapping[int, ArrayLike] | None] | None = None,
    class_avoid: Sequence[Mapping[int, AvoidLike] | None] | None = None,
    features: float | None = None,
    at_vertices: bool = False,
    metric: str = "geodesic",
    weld: bool | float = False,
    keep_seams: bool = False,
    columns: str | Sequence[str] = (),
    attributes: str | Sequence[str] = (),
    texture: str | os.PathLike[str] | None = None,
    normals: str = "face",
    frames: bool | float | str = False,
    up: str | None = None,
    mesh_format: str | None = None,
    allow_outside: bool = False,
    device: DeviceLike | None = None,
    progress: bool | ProgressCallback = False,
) -> list[Samples]:
    """Samples several meshes together, which is faster than sampling them separately.

    Each mesh gets the same samples as from :func:`sample`. Their runs share jobs, as far as every
    device has room for. Runs with `darts`, `stop_count`, `maximal`, `classes`, and metrics other
    than geodesic are jobs of their own.

    Parameters
    ----------
    meshes : iterable of meshes
        Each is a :class:`Mesh`, a path, an object of another package, or a pair of vertices and
        faces, as for :func:`sample`. A :class:`Mesh` may appear several times.
    min_distance, radius, count, seed : number, or a sequence with one per mesh
        As for :func:`sample`.
    density, radius_factor, face_keys, face_mask, existing, avoid, class_masks, class_densities,
    class_avoid : sequence of one per mesh, or None
        As for :func:`sample`; None for a mesh without.
    exact, pool_ratio, darts, stop_count, maximal, order, levels, level_factor, classes,
    class_counts, features, at_vertices, metric, weld, keep_seams, columns, attributes, texture, normals, frames,
    up, mesh_format, allow_outside, device, progress
        As for :func:`sample`, for all meshes.

    Returns
    -------
    list of Samples
        Samples in the order of the meshes. Their reports describe the whole job of a mesh.

    Raises
    ------
    InvalidArgument, MeshRejected, TypeError and the others of :func:`sample`
        With ``mesh 3: `` before the message if the error concerns one mesh.

    Examples
    --------
    >>> import geodisk
    >>> corners = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]
    >>> mesh = geodisk.Mesh(corners, [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
    >>> a, b = geodisk.sample_many([mesh, mesh], min_distance=0.5, seed=[1, 2])
    >>> alone = geodisk.sample(mesh, min_distance=0.5, seed=2)
    >>> bool((b.points == alone.points).all())
    True
    """
    return sample_each(dict(locals(), edge_lengths=None))
