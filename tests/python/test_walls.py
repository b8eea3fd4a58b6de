"""Walls, faces seen from outside, samples at vertices, and disks that hold an area."""

import math

import numpy as np
import pytest

import geodisk

SIDE = 8


def square(side=SIDE):
    """Vertices and triangles of a square with sides of `side`, whose vertex x + (side + 1) y is at x, y."""
    y, x = np.divmod(np.arange((side + 1) ** 2), side + 1)
    v = np.arange(side * (side + 1)).reshape(side, side + 1)[:, :-1].ravel()
    faces = np.concatenate([np.stack([v, v + 1, v + side + 2], 1), np.stack([v, v + side + 2, v + side + 1], 1)])
    return np.stack([x, y, 0 * x], 1).astype(float), faces


def column(end):
    """The edges from (4, 0) to (4, end)."""
    return np.array([[4 + 9 * y, 13 + 9 * y] for y in range(end)])


def test_samples_of_a_mesh_with_walls_are_those_of_the_mesh_without_these_faces():
    vertices, faces = square()
    walls = (vertices[faces, 0].min(1) >= 4) & (vertices[faces, 0].max(1) <= 5)
    order = np.argsort(walls, kind="stable")  # So that the others have the same numbers.
    faces, walls = faces[order], walls[order]
    with_walls = geodisk.Mesh(vertices, faces, walls=walls)
    without = geodisk.Mesh(vertices, faces[~walls])
    assert with_walls.area == without.area == 56
    for how in ({"min_distance": 0.7}, {"count": 40}, {"min_distance": 1, "maximal": True}):
        made, other = geodisk.sample(with_walls, seed=3, **how), geodisk.sample(without, seed=3, **how)
        assert np.array_equal(made.face_index, other.face_index)
        assert np.array_equal(made.points, other.points)
        assert geodisk.verify(made).ok
    assert geodisk.cells(with_walls, made).area.tolist() == geodisk.cells(without, other).area.tolist()
    assert np.isinf(geodisk.geodesic_distances(with_walls, 0)[8])


def test_walls_of_edges_part_a_mesh_and_data_of_vertices_stays_valid(tmp_path):
    vertices, faces = square()
    mesh = geodisk.Mesh(vertices, faces, walls=column(SIDE))
    assert mesh.info["components"] == 2
    assert len(mesh.vertices) == len(vertices) + SIDE + 1
    open_end = geodisk.Mesh(vertices, faces, walls=column(SIDE - 1))
    assert open_end.info["components"] == 1
    around = geodisk.geodesic_distances(open_end, 3)[5]
    assert around == pytest.approx(2 * math.hypot(1, 7))
    factor = np.where(vertices[:, 0] < 5, 1, 0.5)
    made = geodisk.sample(mesh, min_distance=1, radius_factor=factor)
    assert geodisk.verify(made).ok
    assert np.allclose(made.interpolate(vertices), made.points)
    made.save(tmp_path / "a.ply")
    assert geodisk.read(tmp_path / "a.ply")._told["walls"].startswith("8 edges ")
    pickled = __import__("pickle").loads(__import__("pickle").dumps(mesh))
    assert pickled.info == mesh.info
    with pytest.raises(TypeError, match="has walls"):
        geodisk.update(made, to=vertices * 1.1)


def test_walls_change_no_other_face():
    vertices, faces = square()
    copied = np.concatenate([faces, faces[:1]])  # A copy, which stays where arrays are given.
    plain, walled = geodisk.Mesh(vertices, copied), geodisk.Mesh(vertices, copied, walls=copied[:, 0] < 0)
    assert plain.area == walled.area == 64.5
    walls = np.arange(len(faces)) == 9
    assert not [one for one in geodisk.Mesh(vertices, faces, walls=walls).warnings]


def test_faces_of_polygons_are_walls_as_they_are_given():
    quads = [[0, 1, 4, 3], [1, 2, 5, 4]]
    points = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0]]
    mesh = geodisk.Mesh(points, quads, walls=[True, False])
    assert mesh.area == 1
    assert set(geodisk.sample(mesh, min_distance=0.3).polygon_index.tolist()) == {1}


@pytest.mark.parametrize(
    "walls, text",
    [
        ([True, False], "walls has the shape"),
        ([1, 2, 3], "neither a mask of type bool"),
        ([[0, 99999]], "has the vertex 99999"),
        ([[0, 50]], "no face has the vertices 0 and 50"),
    ],
)
def test_walls_that_cannot_be_are_refused(walls, text):
    with pytest.raises(geodisk.InvalidArgument, match=text):
        geodisk.Mesh(*square(), walls=walls)
    with pytest.raises(geodisk.MeshRejected):
        geodisk.Mesh(*square(), walls=np.ones(2 * SIDE * SIDE, bool))


@pytest.mark.parametrize("walls", [column(SIDE), np.arange(2 * SIDE * SIDE) < 9])
@pytest.mark.parametrize("metric", ["euclidean", "approximate"])
def test_other_metrics_take_no_walls(walls, metric):
    mesh = geodisk.Mesh(*square(), walls=walls)
    text = f"metric='{metric}' and walls exclude each other: walls are for paths along the surface"
    with pytest.raises(geodisk.InvalidArgument, match=text):
        geodisk.sample(mesh, min_distance=0.7, metric=metric)
    with pytest.raises(geodisk.InvalidArgument, match=f"mesh 0: {text}"):
        geodisk.sample_many([mesh], min_distance=0.7, metric=metric)


def test_what_is_inside_is_not_seen_from_outside():
    ball = geodisk.Mesh("builtin:icosphere:3")
    vertices = np.concatenate([ball.vertices, 0.5 * ball.vertices])
    faces = np.concatenate([ball.triangles, ball.triangles + len(ball.vertices)])
    seen = geodisk.outside_faces(vertices, faces)
    assert seen.tolist() == [True] * len(ball.triangles) + [False] * len(ball.triangles)
    samples = geodisk.sample(vertices, faces, count=100, face_mask=seen)
    assert np.allclose(np.linalg.norm(samples.points, axis=1), 1, atol=0.05)
    with pytest.raises(geodisk.InvalidArgument, match="share is 2"):
        geodisk.outside_faces(vertices, faces, share=2)


def test_samples_at_vertices_are_vertices(tmp_path):
    mesh = geodisk.Mesh("builtin:icosphere:3")
    samples = geodisk.sample(mesh, min_distance=0.4, at_vertices=True, seed=2)
    assert np.allclose(mesh.vertices[samples.vertices], samples.points)
    assert geodisk.verify(samples).ok
    assert len(set(samples.vertices.tolist())) == len(samples) > 20
    samples.save(tmp_path / "a.csv")
    again = geodisk.read(tmp_path / "a.csv")
    assert np.array_equal(again.vertices, samples.vertices)
    assert len(geodisk.sample(mesh, count=50, exact=True, at_vertices=True)) == 50
    farthest = geodisk.sample(mesh, min_distance=0.4, at_vertices=True, seed=2, order="farthest")
    assert sorted(farthest.vertices.tolist()) == sorted(samples.vertices.tolist())
    more = geodisk.sample(mesh, min_distance=0.4, at_vertices=True, existing=([7], [[0.2, 0.3, 0.5]]))
    assert more.vertices[0] == 2**32 - 1 and (more.vertices[1:] < len(mesh.vertices)).all()
    assert geodisk.sample(mesh, min_distance=0.4).vertices is None
    with pytest.raises(geodisk.InvalidArgument, match="only 642 vertices"):
        geodisk.sample(mesh, count=1000, at_vertices=True)


def test_disks_hold_the_area_asked_for():
    mesh = geodisk.Mesh(*square())
    middle = 4 + 9 * 4
    (radius,) = geodisk.disk_radii(mesh, middle, area=20)
    assert radius == pytest.approx(math.sqrt(20 / math.pi), rel=0.005)
    near = geodisk.neighbours(mesh, sources=[middle, 0], within=geodisk.disk_radii(mesh, [middle, 0], area=20))
    found = [len(indices) for indices, _ in near]
    distances = np.linalg.norm(mesh.vertices - mesh.vertices[middle], axis=1)
    assert found[0] == int((distances < radius).sum())
    with pytest.raises(geodisk.InvalidArgument, match="area is 0"):
        geodisk.disk_radii(mesh, middle, area=0)


def test_walls_go_along_with_samples_to_other_positions():
    vertices, faces = square()
    for walls in (column(5), np.arange(len(faces)) < 9):
        samples = geodisk.sample(geodisk.Mesh(vertices, faces, walls=walls), min_distance=0.6, order="progressive")
        for positions in (2 * vertices, 2 * samples._surface.vertices):
            moved = geodisk.transfer(samples, positions)
            assert moved.min_distance == pytest.approx(2 * geodisk.verify(samples).smallest, rel=1e-6)
            assert moved.level_distances is None and geodisk.verify(moved).ok
        with pytest.raises(geodisk.InvalidArgument, match="there are 80 positions for 81 vertices"):
            geodisk.transfer(samples, vertices[:-1])


def test_samples_of_a_file_tell_which_walls_they_were_made_with(tmp_path):
    vertices, faces = square()
    mesh, other = (geodisk.Mesh(vertices, faces, walls=walls) for walls in (column(5), column(5) + 2))
    geodisk.sample(mesh, min_distance=0.6).save(tmp_path / "a.npz")
    samples = geodisk.read(tmp_path / "a.npz")
    assert len(geodisk.update(samples, vertices=geodisk.Mesh(vertices, faces, walls=column(5)[::-1, ::-1])))
    with pytest.raises(geodisk.InvalidArgument, match="made with walls=5 edges .*; give the mesh before in"):
        geodisk.update(samples, other, vertices=other)
    for wrong in (other, geodisk.Mesh(vertices, faces)):
        with pytest.warns(geodisk.GeodiskWarning, match="made with walls=5 edges .*, and this mesh has"):
            geodisk.verify(samples, wrong)
    assert geodisk.verify(samples, mesh).ok
