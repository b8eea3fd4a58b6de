"""Distances from sources to all vertices, and shortest paths."""

import threading

import numpy as np
import pytest

import geodisk
from meshes import torus


@pytest.fixture(scope="module")
def sphere():
    return geodisk.Mesh("builtin:icosphere:4")


def test_on_a_sphere_they_are_arcs(sphere):
    distances = geodisk.geodesic_distances(sphere, 0)
    arcs = np.arccos(np.clip(sphere.vertices @ sphere.vertices[0], -1, 1))
    assert distances.shape == (len(sphere.vertices),) and distances[0] == 0
    assert np.abs(distances - arcs).max() < 0.01


def test_from_each_and_from_the_nearest(sphere):
    samples = geodisk.sample(sphere, count=5)
    rows = geodisk.geodesic_distances(sphere, samples, each=True)
    distances, nearest = geodisk.geodesic_distances(sphere, samples, return_nearest=True)
    assert rows.shape == (len(samples), len(sphere.vertices))
    assert np.allclose(rows.min(axis=0), distances, rtol=1e-12)
    assert np.allclose(rows[nearest, np.arange(rows.shape[1])], distances, rtol=1e-12)


def test_they_are_those_of_neighbours():
    vertices, faces = torus()
    near = geodisk.neighbours(vertices, faces, [3], within=100.0)
    distances = geodisk.geodesic_distances(vertices, faces, [3])
    assert np.allclose(distances[near.indices], near.distances, atol=1e-5)


def test_points_as_sources_and_targets(sphere):
    samples = geodisk.sample(sphere, count=30)
    matrix = geodisk.geodesic_distances(sphere, samples, targets=samples, each=True)
    assert np.allclose(matrix, matrix.T, atol=1e-9) and (np.diag(matrix) == 0).all()
    by_coordinates = geodisk.geodesic_distances(sphere, samples.points[:1], targets=samples.points)
    assert np.allclose(by_coordinates, matrix[0], atol=1e-5)
    mask = np.zeros(len(sphere.vertices), bool)
    mask[[4, 9]] = True
    few = geodisk.geodesic_distances(sphere, mask)
    assert np.array_equal(few, geodisk.geodesic_distances(sphere, [4, 9]))


@pytest.mark.filterwarnings("ignore:2 components")
def test_limits_and_parts():
    vertices = [[0, 0], [1, 0], [0, 1], [5, 0], [6, 0], [5, 1]]
    faces = [[0, 1, 2], [3, 4, 5]]
    distances, nearest = geodisk.geodesic_distances(vertices, faces, 0, return_nearest=True)
    assert distances.tolist() == [0, 1, 1, np.inf, np.inf, np.inf]
    assert nearest.tolist() == [0, 0, 0, -1, -1, -1]
    assert geodisk.geodesic_distances(vertices, faces, 0, within=0.5).tolist()[1:] == [np.inf] * 5
    with pytest.raises(geodisk.InvalidArgument, match="no path leads"):
        geodisk.geodesic_path(vertices, faces, 0, 4)


def test_paths_lead_from_end_to_end(sphere):
    samples = geodisk.sample(sphere, count=9)
    for end in (17, samples[0], samples.points[1], (7, [0.5, 0.25, 0.25])):
        path = geodisk.geodesic_path(sphere, 3, end)
        legs = np.linalg.norm(np.diff(path.points, axis=0), axis=1)
        assert legs.sum() == pytest.approx(path.length, rel=1e-12)
        assert np.array_equal(path.points[0], sphere.vertices[3])
        corners = sphere.vertices[sphere.triangles[path.face_index]]
        assert np.allclose(np.einsum("nk,nkd->nd", path.barycentric, corners), path.points)
        back = geodisk.geodesic_path(sphere, end, 3)
        assert back.length == pytest.approx(path.length, rel=1e-9)
    assert geodisk.geodesic_path(sphere, 3, 17).length == pytest.approx(
        geodisk.geodesic_distances(sphere, 3)[17], rel=1e-12
    )


def test_surfaces_of_edge_lengths():
    triangle = geodisk.Mesh(3, [[0, 1, 2]], edge_lengths=[[3, 4, 5]])
    assert geodisk.geodesic_distances(triangle, 0).tolist() == [0, 3, 5]
    path = geodisk.geodesic_path(triangle, 1, 2)
    assert path.points is None and path.length == 4 and len(path) == 2


def test_arguments_come_after_a_whole_mesh_or_after_its_faces(sphere):
    radii = geodisk.disk_radii(sphere, [0, 7], 0.1)
    for given in ((sphere.vertices, sphere.triangles, [0, 7], 0.1), (sphere, None, [0, 7], 0.1)):
        assert geodisk.disk_radii(*given).tolist() == radii.tolist()
    assert geodisk.disk_radii(sphere, [0, 7], area=0.1).tolist() == radii.tolist()


def test_bad_queries_are_refused(sphere):
    distances, path = geodisk.geodesic_distances, geodisk.geodesic_path
    for call, error, message in [
        (lambda: distances(sphere), geodisk.InvalidArgument, "give sources"),
        (lambda: distances(sphere, -1), geodisk.InvalidArgument, "sources is -1"),
        (lambda: distances(sphere, 10**6), geodisk.InvalidArgument, "which no face uses"),
        (lambda: distances(sphere, 0, within=0), geodisk.InvalidArgument, "not positive"),
        (lambda: distances(sphere, 0, within=np.nan), geodisk.InvalidArgument, "not positive"),
        (lambda: distances(sphere, [[9, 9, 9]]), geodisk.InvalidArgument, "off the mesh"),
        (
            lambda: distances(sphere, 0, each=True, return_nearest=True),
            geodisk.InvalidArgument,
            "each and return_nearest exclude each other",
        ),
        (lambda: distances(sphere, 0, 5), TypeError, "sources again"),
        (lambda: geodisk.disk_radii(sphere, 0, 5, area=0.1), TypeError, "sources again"),
        (lambda: path(sphere, 0), geodisk.InvalidArgument, "give start and end"),
        (lambda: path(sphere, 0, "x"), TypeError, "end is neither a vertex"),
        (lambda: path(sphere, 0, 10**6), geodisk.InvalidArgument, "is used by no face"),
        (lambda: path(sphere, 0, 1, 2), TypeError, "a third one"),
    ]:
        with pytest.raises(error, match=message):
            call()


def test_progress_is_told_and_can_stop():
    mesh = geodisk.Mesh("builtin:icosphere:5")
    told = []
    geodisk.geodesic_distances(mesh, 0, progress=lambda part, _: told.append(part))
    assert told == sorted(told) and 0 < told[-1] <= 1
    with pytest.raises(geodisk.Cancelled, match="returned False"):
        geodisk.geodesic_distances(mesh, 0, progress=lambda *_: False)
    with pytest.raises(ZeroDivisionError):
        geodisk.geodesic_distances(mesh, range(9), each=True, progress=lambda *_: 1 / 0)


def test_threads_may_share_a_mesh(sphere):
    expected = geodisk.geodesic_distances(sphere, 5)
    found = []
    threads = [
        threading.Thread(target=lambda: found.append(geodisk.geodesic_distances(sphere, 5)))
        for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 4 and all(np.array_equal(one, expected) for one in found)
