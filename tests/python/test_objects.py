"""Meshes of other packages, by objects that have what theirs have."""

import types
import warnings

import numpy as np
import pytest

import geodisk
from meshes import FACES, SOUP, VERTICES, same
from test_mesh_sources import CUBE, SIDES

PADDED = np.concatenate([[4, *side] for side in SIDES])


def thing(**attributes):
    return types.SimpleNamespace(**attributes)


def tensor(array):
    """As Open3D and torch have them: on a device, from which they are copied."""
    array = np.asarray(array)
    on_host = thing(numpy=lambda: array, __dlpack__=array.__dlpack__)
    return thing(cpu=lambda: on_host, numpy=None, __dlpack__=None)


class Graph:
    """The graph of a trimesh.Scene: nodes that place meshes by name."""

    def __init__(self, nodes):
        self._nodes = nodes
        self.nodes_geometry = list(nodes)

    def __getitem__(self, node):
        return self._nodes[node]


def cells(kind, data):
    return thing(type=kind, data=data)


MESHES = {
    "trimesh": thing(vertices=VERTICES, faces=FACES, triangles=VERTICES[FACES]),
    "open3d": thing(vertices=VERTICES, triangles=FACES),
    "open3d.t": thing(
        vertex=thing(positions=tensor(VERTICES)), triangle=thing(indices=tensor(FACES))
    ),
    "pyvista": thing(
        points=VERTICES, faces=np.insert(FACES, 0, 3, axis=1).ravel(), strips=np.array([], int)
    ),
    "meshio": thing(points=VERTICES, cells=[cells("line", [[0, 1]]), cells("triangle", FACES)]),
    "vedo": thing(vertices=VERTICES, cells=FACES.tolist()),
    "scene": thing(
        geometry={"torus": thing(vertices=VERTICES, faces=FACES), "points": thing(vertices=CUBE)},
        graph=Graph({"a": (np.eye(4), "torus"), "b": (np.eye(4), "points")}),
    ),
}


@pytest.mark.parametrize("kind", MESHES)
def test_triangles(kind):
    expected = geodisk.sample(VERTICES, FACES, min_distance=0.5)
    found = geodisk.sample(MESHES[kind], min_distance=0.5)
    assert same(found, expected) and np.array_equal(found.points, expected.points)
    assert found.polygon_index is None


QUADS = {
    "arrays": thing(vertices=CUBE, faces=np.array(SIDES)),
    "lists": thing(vertices=CUBE.tolist(), faces=SIDES),
    "pyvista": thing(points=CUBE, faces=PADDED),
    "grid": thing(points=CUBE, cells=PADDED, celltypes=[9] * 6, extract_surface=None),
    "volume": thing(
        points=CUBE,
        cells=np.array([8, *range(8)]),
        celltypes=[12],
        extract_surface=lambda: thing(points=CUBE, faces=PADDED),
    ),
    "blocks": thing(
        n_blocks=1,
        combine=lambda: thing(points=CUBE, cells=PADDED, celltypes=[9] * 6, extract_surface=None),
    ),
    "meshio": thing(
        points=CUBE,
        cells=[cells("hexahedron", [list(range(8))]), cells("quad", SIDES[:2])]
        + [cells("quad8", [[*side, 0, 0, 0, 0] for side in SIDES[2:5]]), cells("polygon", SIDES[5:])],
    ),
    "vedo": thing(vertices=CUBE, cells=SIDES),
}


@pytest.mark.parametrize("kind", QUADS)
def test_polygons(kind):
    expected = geodisk.sample(CUBE, SIDES, min_distance=0.3)
    found = geodisk.sample(QUADS[kind], min_distance=0.3)
    assert same(found, expected)
    assert np.array_equal(found.polygon_index, found.face_index // 2)


def test_strips_and_mixed_faces():
    strip = thing(points=CUBE[:4], faces=np.array([], int), strips=np.array([4, 0, 1, 2, 3]))
    mesh = geodisk.Mesh(strip)
    assert mesh.area == 1 and mesh.triangles.tolist() == [[0, 1, 2], [2, 1, 3]]
    mixed = thing(points=CUBE, faces=np.array([4, 0, 2, 3, 1, 3, 4, 5, 7, 3, 4, 7, 6]))
    with pytest.warns(geodisk.MeshWarning, match="2 components"):
        mesh = geodisk.Mesh(mixed)
    assert mesh.polygons.tolist() == [0, 0, 1, 2]


def test_seams_are_joined():
    expected = geodisk.sample(VERTICES, FACES, min_distance=0.5)
    mesh = geodisk.Mesh(thing(vertices=SOUP[0], triangles=SOUP[1]))
    assert mesh.info["joined_edges"] == 3 * len(FACES) and mesh.warnings == ()
    assert np.array_equal(geodisk.sample(mesh, min_distance=0.5).face_index, expected.face_index)


def test_scenes_are_placed_by_their_graph():
    cube = thing(vertices=CUBE, faces=np.array(SIDES))
    there = np.diag([-2.0, 1, 1, 1])
    there[:3, 3] = 5, 0, 0
    scene = thing(
        geometry={"cube": cube}, graph=Graph({"a": (np.eye(4), "cube"), "b": (there, "cube")})
    )
    with pytest.warns(geodisk.MeshWarning, match="2 components"):
        mesh = geodisk.Mesh(scene)
    assert mesh.area == 6 + 10 and len(mesh.vertices) == 16
    assert mesh.vertices[8:].min(axis=0).tolist() == [3, 0, 0]
    samples = geodisk.sample(mesh, min_distance=0.4)
    assert samples.polygon_index.max() == 11
    mirrored = samples.polygon_index >= 6
    away = samples.points - np.where(mirrored[:, None], [4, 0.5, 0.5], [0.5, 0.5, 0.5])
    assert ((samples.normals * away).sum(axis=1) < 0).all() == _is_turned_in()


def _is_turned_in():
    """Whether the normals of the cube lead inwards, as the mirrored one has to have them too."""
    samples = geodisk.sample(CUBE, SIDES, min_distance=0.4)
    return ((samples.normals * (samples.points - 0.5)).sum(axis=1) < 0).all()


def test_seams_are_warned_of_at_the_line_of_the_caller():
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        mesh = geodisk.Mesh(thing(vertices=SOUP[0], faces=SOUP[1]), keep_seams=True)
        geodisk.sample(mesh, min_distance=1)
    told = [one.message for one in caught if isinstance(one.message, geodisk.MeshWarning)]
    assert tuple(told) == mesh.warnings
    assert [one.kind for one in told] == ["unwelded", "components"]
    assert told[0].count == 3 * len(FACES)
    assert issubclass(geodisk.MeshWarning, geodisk.GeodiskWarning)
    assert issubclass(geodisk.GeodiskWarning, UserWarning)
    assert all(one.filename == __file__ for one in caught)


@pytest.mark.parametrize(
    "mesh, kind, text",
    [
        (b"a.stl", TypeError, "a mesh is"),
        (None, TypeError, "not NoneType"),
        ({"vertices": CUBE}, TypeError, "not dict"),
        (CUBE, TypeError, "faces are missing"),
        (thing(points=CUBE, cells=[cells("tetra", [[0, 1, 2, 3]])]), ValueError, "cells are: tetra"),
        (thing(points=CUBE, faces=np.array([3, 0, 1])), ValueError, r"faces\[0\] is 3"),
        (thing(points=CUBE, faces=np.array([-3, 0, 1, 2])), ValueError, r"faces\[0\] is -3"),
        (thing(points=CUBE, faces=np.array([3.0, 0, 1, 2])), TypeError, "integers"),
        (thing(geometry={}, graph=Graph({})), ValueError, "scene has no meshes"),
        (thing(vertices=CUBE, faces=[[0, 1, 2, 8]]), geodisk.MeshRejected, "vertex 8"),
        (thing(vertices=CUBE, faces=None), TypeError, "faces"),
    ],
)
def test_what_is_no_mesh(mesh, kind, text):
    with pytest.raises(kind, match=text):
        geodisk.Mesh(mesh)
