"""Vertices and faces of meshes that other packages made. None of them is imported here."""

from __future__ import annotations

import types
from typing import TYPE_CHECKING, Any, Iterable, Iterator, NamedTuple, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _errors as e
from ._arrays import array_of, on_host, unreadable
from ._attributes import Attribute, is_called
from ._polygons import Polygons, from_lists, from_padded, from_rows, from_strips, joined, polygons_of

if TYPE_CHECKING:
    from ._surface import Surface

_WHAT_IS_TAKEN = (
    "a mesh is vertices and faces, a path, or a mesh of geodisk, trimesh, Open3D, PyVista, VTK, "
    "PyMeshLab, meshio, vedo, nibabel, nilearn, PyTorch3D, PyG, Warp or USD"
)

#: What has values, "vertices" or "faces", their name, and the values. Those of faces may be of the
#: shape (f, 3, k), for their corners.
Values = Tuple[str, str, Any]


class Light(NamedTuple):
    """Colours that are amounts of light, which sRGB encodes once they are interpolated."""

    values: Any


class Parts(NamedTuple):
    """What a mesh of another package has."""

    vertices: Any
    faces: Any  #: array_like or Polygons.
    values: Iterable[Values] = ()
    warnings: Sequence[e.MeshWarning] = ()  #: As readers of files give them.


# Corners of the cells of VTK and meshio that are faces. Others of higher order have the corners first.
_FACE_CELLS = {"triangle": 3, "quad": 4, "triangle6": 3, "triangle7": 3, "quad8": 4, "quad9": 4}

_VTK_FACES = {5, 7, 9}  # VTK_TRIANGLE, VTK_POLYGON, VTK_QUAD.


def arrays_of(source: Any) -> Parts:
    """Returns vertices, faces and values. Raises TypeError with advice for what is no mesh."""
    for has, convert in _KINDS:
        if has(source):
            return convert(source)
    if isinstance(source, tuple) and len(source) == 2:
        raise TypeError("vertices and faces are given as two arguments; give *mesh")
    if isinstance(source, (np.ndarray, list, tuple)) or hasattr(source, "__dlpack__"):
        raise TypeError("faces are missing: a mesh is vertices and faces, or brings its faces")
    raise _wrong(source, next((advice for has, advice in _ADVICE if has(source)), ""))


def _wrong(source: Any, advice: str) -> TypeError:
    """Returns the error for an object that is no mesh."""
    after = f"; {advice}" if advice else ""
    return TypeError(f"{_WHAT_IS_TAKEN}, not {type(source).__name__}{after}")


def attributes_of(
    values: Iterable[Values], names: Sequence[str], surface: Surface, face_count: int
) -> tuple[dict[str, Attribute], list[e.MeshWarning]]:
    """Returns the attributes that are named, or all, and warnings of those that cannot be used."""
    counts = {"vertices": surface.vertex_count(), "faces": face_count}
    corners, polygons = surface.own_corners(), surface.polygons
    found: dict[str, Attribute] = {}
    warnings: list[e.MeshWarning] = []
    listed: list[str] = []
    for of, name, given in values:
        is_light = isinstance(given, Light)
        array = array_of(given.values if is_light else given, f"the attribute {name!r}")
        if name.lower() == "normals":
            continue
        if array.dtype == np.uint8 and array.ndim == 2 and array.shape[1] in (3, 4):
            array, name = array / 255, name if "color" in listed else "color"
        if name in listed:
            name = f"{'face' if of == 'faces' else 'vertex'}_{name}"
        listed.append(name)
        if "all" not in names and not is_called(name, array, names):
            continue
        is_of_corners = of == "faces" and array.ndim == 3 and array.shape[1] == 3
        why = ""
        if array.dtype.kind not in "biuf":
            why = f"has values of {array.dtype}, not numbers"
        elif array.shape[:1] != (counts[of],):
            why = f"has the shape {array.shape}, but the mesh has {counts[of]} {of}"
        elif array.ndim > 2 and (not is_of_corners or polygons is not None):
            why = f"has the shape {array.shape}, not a number or a row for each of the {of}"
        elif not np.isfinite(array).all():
            why = "has values that are not finite"
        if why and "all" not in names:
            raise e.MeshRejected(f"the attribute {name!r} {why}", "mesh_rejected")
        if why:
            message = f"the attribute {name!r} {why}, so it is left out"
            warnings.append(e.MeshWarning(message, "attribute_left_out", 1))
            continue
        rows = array.reshape(-1, array.shape[2]) if is_of_corners else array
        own = np.arange(len(rows), dtype=np.uint32).reshape(-1, 3) if is_of_corners else corners
        found[name] = Attribute(
            values=np.ascontiguousarray(rows, np.float64),
            corners=own if of == "vertices" or is_of_corners else None,
            of_vertices=of == "vertices",
            is_whole=array.dtype.kind != "f",
            is_light=is_light,
            polygons=polygons,
        )
    for one in names:
        if one != "all" and not any(is_called(name, x.values, [one]) for name, x in found.items()):
            has = f"only {', '.join(listed)}" if listed else "nor any other"
            raise e.MeshRejected(f"the mesh has no attribute {one!r}, {has}", "mesh_rejected")
    return found, warnings


def is_object(source: Any) -> bool:
    """Returns whether it brings its faces."""
    return not isinstance(source, np.ndarray) and any(has(source) for has, _ in _KINDS)


def faces_of(faces: Any) -> NDArray[Any] | Polygons:
    """Returns triangles as an array of shape (f, 3), and all else as polygons."""
    if isinstance(faces, Polygons):
        return faces
    try:
        array = np.asarray(on_host(faces))
    except ValueError:  # Rows of different lengths.
        return from_lists(faces)
    except MemoryError:
        raise
    except Exception as error:  # Of the object.
        raise unreadable("faces", error) from error
    if array.dtype == object and array.ndim == 1 and array.size > 0:
        return from_lists(faces)
    if array.ndim == 2 and array.shape[1] > 3:
        return from_rows(array)
    return array


def _has(*names: str) -> Any:
    return lambda source: all(_is_there(source, name) for name in names)


def _is_there(source: Any, name: str) -> bool:
    """Returns whether it has an attribute that does not fail."""
    try:
        return hasattr(source, name)
    except Exception:  # Of a property.
        return False


def _is_scene(source: Any) -> bool:
    return _has("geometry", "graph")(source) and hasattr(source.graph, "nodes_geometry")


def _is_meshio(source: Any) -> bool:
    if not _has("points", "cells")(source) or not isinstance(source.cells, (list, tuple)):
        return False
    return all(hasattr(cells, "type") and hasattr(cells, "data") for cells in source.cells)


def _each(of: str, table: Any) -> Iterator[Values]:
    """Returns the values that a dict, or an object like one, has by name."""
    return ((of, name, values) for name, values in table.items())


#: Names of Open3D that are others here.
_NAMES = {"colors": "color", "texture_uvs": "uv"}


def _from_tensors(source: Any) -> Parts:
    def values() -> Iterator[Values]:
        for of, table in (("vertices", source.vertex), ("faces", source.triangle)):
            for _, name, values in _each(of, table):
                if name not in ("positions", "indices"):
                    yield of, _NAMES.get(name, name), values

    return Parts(source.vertex.positions, source.triangle.indices, values())


def _from_scene(scene: Any) -> Parts:
    """Returns all meshes of a scene of trimesh, placed by its graph. Mirrored ones are turned over."""
    vertices: list[NDArray[Any]] = []
    faces: list[Polygons] = []
    count = 0
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        mesh = scene.geometry[name]
        if not hasattr(mesh, "faces") or len(mesh.faces) == 0:
            continue  # Points or paths.
        transform = np.asarray(transform, float)
        corners = np.asarray(mesh.faces).astype(np.int64) + count
        if np.linalg.det(transform[:3, :3]) < 0:
            corners = corners[:, ::-1]
        vertices.append(np.asarray(mesh.vertices) @ transform[:3, :3].T + transform[:3, 3])
        faces.append(from_rows(corners))
        count += len(mesh.vertices)
    if not faces:
        raise e.invalid("the scene has no meshes with faces")
    return Parts(np.concatenate(vertices), _plain(joined(faces)))


def _plain(polygons: Polygons) -> Any:
    """Returns triangles as an array, where all faces are."""
    count = len(polygons.ends)
    if len(polygons.corners) == 3 * count and (np.diff(polygons.ends) == 3).all():
        return polygons.corners.reshape(count, 3)
    return polygons


def _values_of_data(source: Any, times: NDArray[Any] | None = None) -> Iterator[Values]:
    """Returns what PyVista and VTK have for points and, after vertices and lines, for faces.

    The value of each face is there `times` times, as the triangles of a strip need it.
    """
    points = getattr(source, "point_data", {})
    coordinates = getattr(points, "active_texture_coordinates_name", None)
    for of, name, values in _each("vertices", points):
        yield of, "uv" if name == coordinates else name, values
    others = getattr(source, "n_verts", 0) + getattr(source, "n_lines", 0)
    for of, name, values in _each("faces", getattr(source, "cell_data", {})):
        own = values[others:]
        if times is not None and len(own) == len(times):
            own = np.repeat(own, times, axis=0)
        yield of, name, own


def _from_polydata(source: Any) -> Parts:
    faces = np.asarray(source.faces)
    if faces.ndim > 1:  # Rows, as trimesh has them.
        return Parts(np.asarray(source.points), faces, _values_of_data(source))
    parts, times = [from_padded(faces)], None
    if hasattr(source, "strips"):
        strips = from_padded(source.strips)
        sizes = np.diff(strips.ends.astype(np.int64), prepend=0)
        times = np.concatenate([np.ones(len(parts[0]), np.int64), np.maximum(sizes - 2, 0)])
        parts.append(from_strips(strips))
    if not any(map(len, parts)):
        raise TypeError(
            "the mesh has points without faces; give pyvista.wrap(mesh).reconstruct_surface()"
        )
    values = _values_of_data(source, times)
    return Parts(np.asarray(source.points), _plain(joined(parts)), values)


def _from_vtk(source: Any) -> Parts:
    """Returns what a vtkPolyData has, by the names that PyVista has for it."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    def padded(cells: Any) -> NDArray[Any]:
        ends = vtk_to_numpy(cells.GetOffsetsArray())
        return np.insert(vtk_to_numpy(cells.GetConnectivityArray()), ends[:-1], np.diff(ends))

    def named(data: Any) -> dict[str, NDArray[Any]]:
        arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
        found = {x.GetName(): vtk_to_numpy(x) for x in arrays if x is not None and x.GetName()}
        if (places := data.GetTCoords()) is not None and places.GetName():
            found["uv"] = found.pop(places.GetName())
        return found

    points = source.GetPoints()
    return _from_polydata(
        types.SimpleNamespace(
            points=np.empty((0, 3)) if points is None else vtk_to_numpy(points.GetData()),
            faces=padded(source.GetPolys()),
            strips=padded(source.GetStrips()),
            n_verts=source.GetNumberOfVerts(),
            n_lines=source.GetNumberOfLines(),
            point_data=named(source.GetPointData()),
            cell_data=named(source.GetCellData()),
        )
    )


def _from_grid(source: Any) -> Parts:
    """Returns the cells that are faces, or else the outer surface of those in space."""
    if hasattr(source, "celltypes") and set(np.unique(source.celltypes)) <= _VTK_FACES:
        faces = _plain(from_padded(source.cells))
        return Parts(np.asarray(source.points), faces, _values_of_data(source))
    try:
        surface = source.extract_surface(algorithm="dataset_surface")
    except TypeError:  # Of an older PyVista, which has no other.
        surface = source.extract_surface()
    return _from_polydata(surface)


def _from_meshio(source: Any) -> Parts:
    parts, used = [], []
    for number, cells in enumerate(source.cells):
        kind = str(cells.type)
        if kind in _FACE_CELLS:
            parts.append(from_rows(np.asarray(cells.data)[:, : _FACE_CELLS[kind]]))
        elif kind == "polygon" or kind.startswith("polygon"):
            parts.append(from_lists(list(cells.data)))
        else:
            continue
        used.append(number)
    if not parts:
        kinds = ", ".join(sorted({str(cells.type) for cells in source.cells})) or "none"
        raise e.invalid(f"the mesh has no faces; its cells are: {kinds}")

    def values() -> Iterator[Values]:
        yield from _each("vertices", source.point_data)
        for of, name, blocks in _each("faces", source.cell_data):
            yield of, name, np.concatenate([blocks[number] for number in used])

    return Parts(np.asarray(source.points), _plain(joined(parts)), values())


def _from_vedo(source: Any) -> Parts:
    def values() -> Iterator[Values]:
        yield from _each("vertices", source.pointdata)
        yield from _each("faces", source.celldata)

    return Parts(np.asarray(source.vertices), source.cells, values())


def _from_faces(source: Any) -> Parts:
    def values() -> Iterator[Values]:
        visual = getattr(source, "visual", None)
        kind = getattr(visual, "kind", None)
        if visual is not None and kind == "vertex":
            yield "vertices", "color", visual.vertex_colors
        if visual is not None and kind == "face":
            yield "faces", "color", visual.face_colors
        if visual is not None and kind == "texture" and visual.uv is not None:
            yield "vertices", "uv", visual.uv
        yield from _each("vertices", getattr(source, "vertex_attributes", {}))
        yield from _each("faces", getattr(source, "face_attributes", {}))

    return Parts(source.vertices, source.faces, values())


def _from_triangles(source: Any) -> Parts:
    def values() -> Iterator[Values]:
        if len(colours := getattr(source, "vertex_colors", ())):
            yield "vertices", "color", colours
        if len(places := getattr(source, "triangle_uvs", ())):
            yield "faces", "uv", np.asarray(places).reshape(-1, 3, 2)

    return Parts(np.asarray(source.vertices), np.asarray(source.triangles), values())


def _from_pymeshlab(source: Any) -> Parts:
    if hasattr(source, "mesh_number") and source.mesh_number() == 0:
        raise _wrong(source, "it is empty: call meshes.load_new_mesh(path) before")
    mesh = source.current_mesh() if hasattr(source, "current_mesh") else source

    def values() -> Iterator[Values]:
        for of, part in (("vertices", "vertex"), ("faces", "face")):
            for name, form in (("color", "matrix"), ("scalar", "array")):
                if getattr(mesh, f"has_{part}_{name}")():
                    yield of, name, getattr(mesh, f"{part}_{name}_{form}")()
        if mesh.has_wedge_tex_coord():
            yield "faces", "uv", mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2)
        elif mesh.has_vertex_tex_coord():
            yield "vertices", "uv", mesh.vertex_tex_coord_matrix()

    return Parts(mesh.vertex_matrix(), mesh.face_matrix(), values())


def _from_gifti(image: Any) -> Parts:
    """Returns the surface of an image of nibabel, and its values by the names that files give them."""
    from nibabel.nifti1 import intent_codes, xform_codes

    arrays = [
        (intent_codes.niistring[one.intent].replace("NIFTI_INTENT_", "").lower(), one)
        for one in image.darrays
    ]
    parts = {intent: one for intent, one in arrays if intent in ("pointset", "triangle")}
    if len(parts) < 2:
        raise _wrong(image, "it has no surface: load the image of a .surf.gii file")

    points, system = parts["pointset"], parts["pointset"].coordsys

    def values() -> Iterator[Values]:
        for intent, one in arrays:
            if intent not in ("pointset", "triangle", "node_index"):
                is_of_vertices = len(one.data) == len(points.data)
                of = "vertices" if is_of_vertices else "faces"
                yield of, one.meta.get("Name") or intent, one.data

    warnings = []
    if system is not None and not np.array_equal(system.xform, np.eye(4)):
        space = xform_codes.niistring[system.xformspace]
        message = f"transform to {space!r} ignored: coordinates are as the file has them"
        warnings.append(e.MeshWarning(message, "transform_ignored", 1))
    return Parts(points.data, parts["triangle"].data, values(), warnings)


def _from_pytorch3d(source: Any) -> Parts:
    vertices, faces = source.verts_list(), source.faces_list()
    if len(vertices) != 1:
        advice = f"{len(vertices)} meshes: give one, as meshes[0], or all to sample_many(meshes)"
        raise _wrong(source, advice)

    def values() -> Iterator[Values]:
        if hasattr(source.textures, "verts_features_list"):
            (features,) = source.textures.verts_features_list()
            yield "vertices", "color" if features.shape[1] == 3 else "features", features

    return Parts(vertices[0], faces[0], values())


def _from_pyg(source: Any) -> Parts:
    if source.face is None:
        advice = "its face is None: keep faces, as by FaceToEdge(remove_faces=False)"
        raise _wrong(source, advice)
    if source.pos is None:
        raise _wrong(source, "its pos is None: give Data(pos=vertices, face=faces.T)")

    def values() -> Iterator[Values]:
        for of, name, given in _each("vertices", source.to_dict()):
            if name != "pos" and source.is_node_attr(name):
                yield of, name, given

    return Parts(source.pos, rows_of_columns(source.face), values())


def rows_of_columns(face: Any) -> NDArray[Any]:
    """Returns the triangles that PyG has as columns, as rows."""
    faces = array_of(face, "face")
    if faces.ndim != 2 or faces.shape[0] != 3:
        raise e.invalid(f"face has the shape {faces.shape}, not (3, f)")
    return faces.T


def _from_warp(source: Any) -> Parts:
    return Parts(source.points, array_of(source.indices, "indices").reshape(-1, 3))


def _of_usd(attribute: Any) -> Any:
    """Returns the value of an attribute, or its first one in time; None without one."""
    from pxr import Usd

    value = attribute.Get()
    return attribute.Get(Usd.TimeCode.EarliestTime()) if value is None else value


def _from_usd(mesh: Any) -> Parts:
    """Returns a UsdGeom.Mesh, placed in its stage. One that is mirrored or left-handed is turned over."""
    from pxr import Usd, UsdGeom

    if not mesh:
        advice = "its prim is no mesh: keep stage, and give UsdGeom.Mesh(stage.GetPrimAtPath(path))"
        raise _wrong(mesh, advice)
    points, corners, counts, holes = (
        np.asarray([] if (value := _of_usd(one)) is None else value)
        for one in (
            mesh.GetPointsAttr(),
            mesh.GetFaceVertexIndicesAttr(),
            mesh.GetFaceVertexCountsAttr(),
            mesh.GetHoleIndicesAttr(),
        )
    )
    counts = counts.astype(np.int64)
    if (counts < 0).any() or counts.sum() != len(corners):
        raise e.MeshRejected(
            f"faceVertexCounts is not for {len(corners)} faceVertexIndices", "mesh_rejected"
        )
    matrix = np.array(mesh.ComputeLocalToWorldTransform(Usd.TimeCode.Default()))
    places = points.reshape(-1, 3).astype(float) @ matrix[:3, :3] + matrix[3, :3]
    is_left = _of_usd(mesh.GetOrientationAttr()) == UsdGeom.Tokens.leftHanded
    starts = np.repeat(np.cumsum(counts) - counts, counts)
    order = np.arange(len(corners))
    if is_left != (np.linalg.det(matrix[:3, :3]) < 0):
        order = starts + (starts - order) % np.maximum(np.repeat(counts, counts), 1)
    is_hole = np.isin(np.arange(len(counts)), holes)
    order = order[~np.repeat(is_hole, counts)]
    faces = _plain(polygons_of(corners[order], np.where(is_hole, 0, counts)))

    def values() -> Iterator[Values]:
        for primvar in UsdGeom.PrimvarsAPI(mesh).GetPrimvarsWithValues():
            array = np.asarray(primvar.ComputeFlattened())
            name = {"st": "uv", "displayColor": "color"}.get(name := primvar.GetPrimvarName(), name)
            kind = primvar.GetInterpolation()
            if array.dtype.kind not in "biuf" or name in ("normals", "displayOpacity"):
                continue
            if kind in (UsdGeom.Tokens.vertex, UsdGeom.Tokens.varying):
                of = "vertices"
            elif kind == UsdGeom.Tokens.uniform:
                of = "faces"
            elif kind == UsdGeom.Tokens.constant:
                of = "vertices"
                array = np.repeat(array.reshape(1, *array.shape[1:]), len(places), axis=0)
            else:
                of, array = "faces", array[order] if len(array) == len(corners) else array
                if not isinstance(faces, Polygons) and len(array) == 3 * len(faces):
                    array = array.reshape(len(faces), 3, -1)
            yield of, name, Light(array) if name == "color" else array

    return Parts(places, faces, values(), _warnings_of_usd(mesh))


def _warnings_of_usd(mesh: Any) -> list[e.MeshWarning]:
    """Returns what a reader of the file warns of that concerns this mesh."""
    from pxr import UsdGeom

    prim = mesh.GetPrim()
    stage = prim.GetStage()
    found = []
    if mesh.GetSubdivisionSchemeAttr().Get() != UsdGeom.Tokens.none:
        message = f"1 subdivision surface: the mesh that controls it is read (<{prim.GetPath()}>)"
        found.append(e.MeshWarning(message, "control_meshes", 1))
    metres = UsdGeom.GetStageMetersPerUnit(stage)
    if UsdGeom.StageHasAuthoredMetersPerUnit(stage) and metres not in (0, 1):
        message = f"coordinates are as the file has them: a unit is {metres:.6g} m"
        if stage.HasAuthoredMetadata(UsdGeom.Tokens.upAxis):
            message += f", and {UsdGeom.GetStageUpAxis(stage)} points up"
        found.append(e.MeshWarning(message, "scene_units", 1))
    return found


# In this order: some have the attributes of several.
_KINDS = (
    (_is_scene, _from_scene),
    (_has("vertex", "triangle"), _from_tensors),
    (_is_meshio, _from_meshio),
    (_has("vertices", "faces"), _from_faces),
    (_has("vertices", "triangles"), _from_triangles),
    (_has("vertices", "cells"), _from_vedo),
    (_has("points", "faces"), _from_polydata),
    (_has("points", "extract_surface"), _from_grid),
    (_has("n_blocks", "combine"), lambda source: _from_grid(source.combine())),
    (_has("GetPolys", "GetStrips"), _from_vtk),
    (_has("current_mesh"), _from_pymeshlab),
    (_has("vertex_matrix", "face_matrix"), _from_pymeshlab),
    (_has("darrays", "agg_data"), _from_gifti),
    (_has("coordinates", "faces"), lambda source: Parts(source.coordinates, source.faces)),
    (_has("verts_list", "faces_list"), _from_pytorch3d),
    (_has("pos", "face"), _from_pyg),
    (_has("points", "indices"), _from_warp),
    (lambda source: hasattr(type(source), "GetFaceVertexIndicesAttr"), _from_usd),
)

#: Objects that are no mesh, and how to make one of them.
_ADVICE = (
    (_has("GetDataObjectType"), "give pyvista.wrap(mesh).extract_surface().triangulate()"),
    (_has("GetPrimTypeInfo"), "give UsdGeom.Mesh(prim)"),
    (_has("GetPseudoRoot"), 'call stage.Flatten().Export("a.usda") and give "a.usda"'),
    (_has("GetOutputPort"), "call source.Update() and give source.GetOutput()"),
    (_has("mesh", "data"), 'give one hemisphere: image.mesh.parts["left"]'),
    (_has("parts"), 'give one hemisphere: mesh.parts["left"]'),
    (
        _has("vertices", "entities"),
        "lines have no faces: give *path.to_2D()[0].triangulate(), for a closed and flat path",
    ),
    (
        _has("points", "normals"),
        "points need faces: give TriangleMesh.create_from_point_cloud_poisson(cloud)[0]",
    ),
    (_has("vertices", "convex_hull"), "points need faces: give a mesh, as cloud.convex_hull"),
)
