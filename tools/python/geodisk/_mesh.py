"""Meshes prepared for any number of runs."""

from __future__ import annotations

import dataclasses
import os
from typing import Any, Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._arrays import array_of, indices
from ._background import interruptible
from ._objects import Values, arrays_of, attributes_of, faces_of, is_object
from ._oddities import oddities_of, warn
from ._polygons import Polygons, from_rows
from ._protocols import Faces, MeshLike
from ._record import NOTHING, Record, check_record
from ._source import MeshFile, Source, read_file, split
from ._surface import Surface
from ._values import flag, names, path_of, text, weld_of
from ._walls import cut


#: Oddities that walls make: faces that are none now, and borders beside each other.
_OF_WALLS = ("repeated_vertices", "unwelded")


class Mesh:
    """A mesh, prepared for any number of runs.

    Parameters
    ----------
    vertices : array_like of float, shape (v, d), or a mesh
        Coordinates, d from 2 to 8, in an array of numpy, torch, CuPy, JAX or Warp. Their unit is
        that of all distances. Or a mesh with faces: the path of a file, an object of trimesh (meshes
        and scenes), Open3D (legacy and tensor meshes), PyVista, VTK, PyMeshLab, meshio, vedo,
        nibabel, nilearn, PyTorch3D, PyG, Warp or USD, or any object with ``vertices`` and ``faces``.
    faces : array_like of int, shape (f, 3) or (f, k), or sequence of sequences
        Vertices of each face. Polygons are split into triangles.
    edge_lengths : array_like of float, shape (f, 3), optional
        Edge lengths instead of coordinates: for each face from its first corner to the second, to
        the third, and back. ``vertices`` is then the number of vertices.
    weld : bool or float
        Join vertices at the same place, or at most this far apart.
    keep_seams : bool
        Do not join border edges that coincide exactly, as along seams of texture coordinates.
        By default they are joined; ``info["joined_edges"]`` counts them.
    walls : array_like of bool, shape (f,), or of int, shape (k, 2), optional
        Triangles (or faces as given) that no path crosses, as a mask; they hold no samples. Or edges
        that no path crosses, by their vertices: both sides then have vertices of their own, and
        `vertices` has copies at its end.
    attributes : sequence of str, or "all"
        Names of attributes to read from a file or an object of another package: ``"color"``,
        ``"uv"`` and others as the file or object calls them. Samples have their values.
    columns : sequence of str
        Numbers to read for each triangle of a file: any of ``"part"`` (that no path joins to
        others), ``"material"``, ``"group"``, and for glTF ``"mesh"``, ``"primitive"`` and
        ``"node"``; 4294967295 for none. Samples have them as well.
    mesh_format : str, optional
        Read the file as gltf, glb, obj, off, ply, stl, vtk, vtp, gii, asc, usda, usd or freesurfer, ignoring
        its extension.
    allow_outside : bool
        Read files that the mesh names outside of its folder too, such as buffers and images.

    Attributes
    ----------
    vertices : ndarray of float, shape (v, d), or int
    triangles : ndarray of int, shape (f, 3)
        The triangles that ``Samples.face_index`` refers to.
    polygons : ndarray of uint32, shape (f,), or None
        Number of the given face that each triangle is part of. None if all faces are triangles,
        since the numbers are the same then.
    attributes : dict of ndarray, shape (v,) or (v, k)
        Values of vertices; of corners with the shape (f, 3) or (f, 3, k), of faces (f,) or (f, k).
    columns : dict of ndarray of uint32, shape (f,)
    warnings : tuple of MeshWarning
        All oddities of the mesh. They are also shown once, when the mesh is made.

    Raises
    ------
    MeshRejected
        For a mesh that cannot be sampled; ``element`` is the face or vertex. Also for a file without
        a mesh.
    OSError
        For a file that does not exist or cannot be read.
    TypeError, InvalidArgument
        For arrays of a wrong type or shape.

    Warns
    -----
    MeshWarning
        For open seams and other oddities.

    Notes
    -----
    Files are read as the program reads them: *.gltf, *.glb, *.obj, *.off, *.ply, *.stl,
    *.vtk, *.vtp, *.gii, *.asc, *.usda, binary surfaces of FreeSurfer and ``builtin:NAME``.

    float32 and float64 coordinates are read in place, also as a part of wider arrays; other types
    are copied first. The mesh and samples on it keep references to the arrays, for :func:`verify`
    and others, so do not change them. Any number of faces may share an edge. Faces may have either
    orientation and leave borders open.

    Meshes can be pickled and copied, with their arrays.

    Examples
    --------
    >>> import geodisk
    >>> mesh = geodisk.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    >>> mesh.area, mesh.triangles.tolist(), mesh.polygons.tolist()
    (1.0, [[0, 1, 2], [0, 2, 3]], [0, 0])
    """

    _source: c.Handle | None = None  # Which pickles do not have.
    _file: MeshFile | None = None  # What it was read from.

    def __init__(
        self,
        vertices: ArrayLike | MeshLike,
        faces: Faces | None = None,
        *,
        edge_lengths: ArrayLike | None = None,
        weld: bool | float = False,
        keep_seams: bool = False,
        walls: ArrayLike | None = None,
        attributes: str | Sequence[str] = (),
        columns: str | Sequence[str] = (),
        mesh_format: str | None = None,
        allow_outside: bool = False,
        _record: Record = NOTHING,
        _prefix: str = "",
    ) -> None:
        told: Sequence[e.MeshWarning] = ()
        left_out: list[e.MeshWarning] = []
        weld, keep_seams = weld_of(weld), flag(keep_seams, "keep_seams")
        allow_outside = flag(allow_outside, "allow_outside")
        attributes, columns = names(attributes, "attributes"), names(columns, "columns")
        if mesh_format is not None:
            text(mesh_format, "mesh_format")
        if faces is None and isinstance(vertices, (str, os.PathLike)):
            if edge_lengths is not None:
                raise TypeError("edge_lengths need faces given as arrays, not a file")
            file = MeshFile(path_of(vertices), weld, keep_seams, mesh_format, allow_outside)
            source = read_file(
                file,
                attributes=attributes,
                columns=columns,
                has_normals=_record.normals == "file",
                has_uvs=_record.texture is not None and not _record.has_materials(),
                has_materials=_record.has_materials(),
            )
            self._file = file.absolute()
        else:
            if columns or mesh_format is not None:
                raise TypeError("columns and mesh_format are for meshes from files")
            _record.check_no_file()
            points: Any = vertices
            values: Iterable[Values] = ()
            if faces is None:
                points, faces, values, told = arrays_of(vertices)
            elif attributes:
                raise TypeError(
                    "attributes are for meshes from files and other packages; with arrays, give "
                    "values to samples.interpolate()"
                )
            if hasattr(points, "__dlpack__"):  # As numpy has it as well.
                points = array_of(points, "vertices")
            given = faces_of(faces)
            if isinstance(given, Polygons):
                if edge_lengths is not None:
                    raise e.invalid("with edge lengths, all faces must be triangles")
                source = split(Surface(points, None).coordinates(), given, weld, keep_seams)
                source = source.changed(vertices=points, given_faces=len(given))
            elif walls is not None and edge_lengths is None:
                source = joined(Surface(points, given, weld=weld, keep_seams=keep_seams, is_joined=True))
            else:
                source = Source(Surface(points, given, edge_lengths, weld, keep_seams))
            if attributes:
                found, left_out = attributes_of(values, attributes, source.surface, len(given))
                source = source.changed(attributes=found)
        if walls is not None:
            source = source._replace(surface=cut(source.surface, walls))
        self._make(source, _record, (*told, *left_out), _prefix)

    def _make(
        self,
        source: Source,
        record: Record,
        told: Sequence[e.MeshWarning] = (),
        prefix: str = "",
    ) -> None:
        """Makes the mesh, and shows what is odd about it after what readers told."""
        record.check(source.surface)
        self._source = source.handle
        check_record(self, record)
        self._prepare(source.surface, source.joined_edges)
        oddities = oddities_of(self._handle, source.handle)
        if source.surface.walls:
            oddities = tuple(one for one in oddities if one.kind not in _OF_WALLS)
        self.warnings = (*told, *oddities)
        warn(self.warnings, prefix)

    def _prepare(self, surface: Surface, joined_edges: int = 0) -> None:
        self._surface = surface
        self._handle = interruptible(lambda stop: created(surface))
        self._info = c.filled(s.MeshInfo, "geodisk_mesh_describe", self._handle)
        self._info.joined_edges += joined_edges

    @property
    def vertices(self) -> Any:
        """Coordinates, or the number of vertices of a mesh of edge lengths."""
        if self._surface.edge_lengths is not None:
            return self._surface.vertex_count()
        return self._surface.coordinates()

    @property
    def triangles(self) -> NDArray[Any]:
        """Vertices of each triangle."""
        return self._surface.indices()

    @property
    def polygons(self) -> NDArray[np.uint32] | None:
        """The face, as given, of each triangle; None if the numbers are the same."""
        return self._surface.polygons

    @property
    def attributes(self) -> dict[str, NDArray[np.float64]]:
        """Attributes that were read, by name."""
        return {name: one.array() for name, one in self._surface.attributes.items()}

    @property
    def columns(self) -> dict[str, NDArray[np.uint32]]:
        """Values of the triangles that were read, by name."""
        return dict(self._surface.columns)

    @property
    def area(self) -> float:
        """Area of the surface."""
        return float(self._info.area)

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounding box; 0 for a mesh of lengths."""
        return float(self._info.diagonal)

    @property
    def info(self) -> dict[str, int | float]:
        """Counts of vertices, faces, components, boundary edges and the like."""
        return dict(self._info.items())

    def __repr__(self) -> str:
        return f"<geodisk.Mesh of {self._info.faces} faces, area {self.area:.6g}>"

    def __getstate__(self) -> dict[str, Any]:
        return {
            "surface": self._surface,
            "warnings": self.warnings,
            "file": self._file,
            "joined_edges": self._info.joined_edges if self._surface.joined is not None else 0,
        }

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._prepare(state["surface"], state["joined_edges"])
        self._file = state["file"]
        self.warnings = state["warnings"]  # Which were shown when it was made.

    def __copy__(self) -> Mesh:
        copied = Mesh.__new__(Mesh)
        copied.__dict__.update(self.__dict__)
        return copied


def joined(plain: Surface) -> Source:
    """Returns a surface of triangles with its vertices joined."""
    corners = plain.indices()
    source = split(plain.coordinates(), from_rows(corners), plain.weld, plain.keep_seams)
    vertices = source.surface.joined
    if vertices is None:
        return Source(plain)
    surface = dataclasses.replace(plain, faces=vertices[corners], corners=corners, joined=vertices)
    return Source(surface, None, source.joined_edges)


def posed(surface: Surface, positions: Any, record: Record) -> Mesh:
    """Returns a mesh of the same faces, cut along the same walls, with its vertices at other positions."""
    places = Surface(positions, None).coordinates()
    if surface.copied is not None and len(places) == surface.own_vertex_count():
        places = np.concatenate([places, places[surface.copied]])
    if len(places) != surface.vertex_count():
        raise e.invalid(f"there are {len(places)} positions for {surface.own_vertex_count()} vertices")
    record.check_no_file()
    moved = dataclasses.replace(surface, vertices=places, edge_lengths=None, attributes={}, columns={})
    mesh = Mesh.__new__(Mesh)
    mesh._make(Source(moved), record)
    return mesh


def prepared(surface: Surface) -> Mesh:
    """Returns the mesh of samples that were made on a surface. What is odd was shown then."""
    mesh = Mesh.__new__(Mesh)
    mesh._prepare(surface)
    mesh.warnings = ()
    return mesh


def created(surface: Surface) -> c.Handle:
    """Returns the library's mesh."""
    corners = surface.indices()
    params = s.MeshParams(
        indices=corners,
        index_type=s.UINT16 if corners.dtype == np.uint16 else s.UINT32,
        face_count=len(corners),
    )
    if surface.weld is not False and not surface.is_joined:
        params.weld = 1
        params.weld_distance = 0.0 if surface.weld is True else float(surface.weld)
    params.keep_seams = surface.keep_seams or surface.copied is not None
    if surface.edge_lengths is None:
        coordinates = surface.coordinates()
        params.positions = coordinates
        params.position_type = s.FLOAT32 if coordinates.dtype == np.float32 else s.FLOAT64
        params.dimension = coordinates.shape[1]
        params.vertex_count = len(coordinates)
        params.position_stride = coordinates.strides[0]
    else:
        lengths = surface.lengths()
        params.edge_lengths = lengths
        params.vertex_count = surface.vertex_count()
    return c.Handle("mesh", "geodisk_mesh_create", params)


def is_mesh(source: Any) -> bool:
    """Returns whether it brings its faces, rather than being coordinates."""
    return isinstance(source, (Mesh, str, os.PathLike)) or is_object(source)


def is_joined_by(weld: bool | float, keep_seams: bool) -> bool:
    """Returns whether arguments say how vertices are joined."""
    return weld_of(weld) is not False or flag(keep_seams, "keep_seams")


def mesh_of(
    vertices: ArrayLike | MeshLike,
    faces: Faces | None = None,
    *,
    record: Record = NOTHING,
    prefix: str = "",
    **how: Any,
) -> Mesh:
    """Returns the mesh that arguments of a function name, those of :class:`Mesh`, read for `record`."""
    if not isinstance(vertices, Mesh):
        return Mesh(vertices, faces, **how, _record=record, _prefix=prefix)
    is_joined = is_joined_by(how.get("weld", False), how.get("keep_seams", False))
    if faces is not None or how.get("edge_lengths") is not None or is_joined:
        raise TypeError("a geodisk.Mesh has its faces, lengths and welds already")
    read = [names(how.get(name, ()), name) for name in ("columns", "attributes")]
    if any(read) or how.get("mesh_format") is not None:
        raise TypeError(
            "a geodisk.Mesh has its columns already; give columns, attributes and mesh_format to it"
        )
    record.check_no_file()
    record.check(vertices._surface)
    return vertices


def joins_for(to: Any, surface: Surface) -> dict[str, Any]:
    """Returns how vertices of `to` are joined, as those of a surface are; nothing for a Mesh."""
    if isinstance(to, Mesh):
        return {}
    return {"weld": surface.weld, "keep_seams": surface.keep_seams}


def attributes_with(
    attributes: str | Sequence[str], vertices: Any, *values: ArrayLike | None
) -> str | Sequence[str]:
    """Returns the attributes to read of a mesh, also those that name values if it has attributes."""
    named = [value for value in values if isinstance(value, str)]
    if not named or attributes == "all" or isinstance(vertices, Mesh) or not is_mesh(vertices):
        return attributes
    given = [attributes] if isinstance(attributes, str) else list(attributes)
    return [*given, *(name for name in named if name not in given)]


def mask_of(
    surface: Surface, face_mask: ArrayLike, name: str = "face_mask"
) -> NDArray[np.uint8]:
    """Returns which triangles take samples, as the library takes it."""
    given = array_of(face_mask, name)
    triangles = len(surface.indices())
    if given.ndim == 0:
        raise e.invalid(f"{name} is {given}, neither a mask nor a list of triangles")
    if given.dtype.kind != "b":
        chosen = indices(given, name)
        if chosen.ndim != 1:
            raise e.invalid(f"{name} has the shape {chosen.shape}, not (k,)")
        if chosen.size and int(chosen.max()) >= triangles:
            raise e.invalid(
                f"{name} has the triangle {chosen.max()}, the mesh has {triangles}; a mask of "
                "zeros and ones must be of type bool"
            )
        if chosen.size > 2 and int(chosen.max()) <= 1:  # Indices would repeat.
            raise e.invalid(f"{name} is a mask of zeros and ones, which must be of type bool")
        mask = np.zeros(triangles, np.uint8)
        mask[chosen] = 1
        return mask
    return surface.mask(given, name)


def keys_of(mesh: Mesh, face_keys: ArrayLike) -> NDArray[np.uint32]:
    """Returns keys of faces as the library takes them."""
    keys = indices(face_keys, "face_keys").astype(np.uint32, copy=False)
    if keys.shape != (mesh._info.faces,):
        raise e.invalid(f"face_keys have the shape {keys.shape}, not ({mesh._info.faces},)")
    if len(np.unique(keys)) != len(keys):
        raise e.invalid("two face_keys are alike")
    return keys
