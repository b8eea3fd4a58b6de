"""Many meshes as one job: the samples of each by itself."""

import numpy as np
import pytest

import geodisk
from meshes import FACES, TETRAHEDRON, VERTICES, same
from test_mesh_sources import CUBE, SIDES

MESHES = [geodisk.Mesh(VERTICES, FACES), TETRAHEDRON, (CUBE, SIDES), geodisk.Mesh(VERTICES, FACES)]


def test_each_gets_its_own_samples():
    found = geodisk.sample_many(
        MESHES, min_distance=[0.5, 0.3, 0.2, 0.4], seed=[1, 2, 3, 1], pool_ratio=10
    )
    for mesh, distance, seed, samples in zip(MESHES, [0.5, 0.3, 0.2, 0.4], [1, 2, 3, 1], found):
        arguments = mesh if isinstance(mesh, tuple) else (mesh,)
        alone = geodisk.sample(*arguments, min_distance=distance, seed=seed, pool_ratio=10)
        assert same(samples, alone) and np.array_equal(samples.points, alone.points)
        assert samples.min_distance == distance and samples.seed == seed
        assert np.array_equal(samples.radius, alone.radius)
    assert found[2].polygon_index is not None and found[0].polygon_index is None
    assert geodisk.sample_many([], min_distance=1) == []


def test_a_mesh_of_a_later_job_is_named():
    with pytest.raises(geodisk.InvalidArgument, match="^mesh 37: the minimum distance is too small"):
        geodisk.sample_many([MESHES[0]] * 60, min_distance=[0.3] * 37 + [1e-7] + [0.3] * 22)


def test_counts_densities_and_keys():
    found = geodisk.sample_many(MESHES[:3], count=[100, 60, 80])
    for mesh, count, samples in zip(MESHES, [100, 60, 80], found):
        arguments = mesh if isinstance(mesh, tuple) else (mesh,)
        alone = geodisk.sample(*arguments, count=count)
        assert same(samples, alone) and samples.min_distance == alone.min_distance
    density = np.linspace(0, 1, len(VERTICES))
    keys = np.arange(len(FACES))[::-1]
    a, b, flat = geodisk.sample_many(
        [MESHES[0], MESHES[0], ([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])],
        min_distance=[0.6, 0.6, 0.1],
        density=[density, None, None],
        face_keys=[None, keys, None],
        face_mask=[None, None, [0]],
    )
    assert same(a, geodisk.sample(MESHES[0], min_distance=0.6, density=density))
    assert same(b, geodisk.sample(MESHES[0], min_distance=0.6, face_keys=keys))
    assert flat.points.shape[1] == 2 and flat.normals is None  # Of another dimension.


@pytest.mark.parametrize(
    "options",
    [
        {"min_distance": 0.3, "darts": 400},
        {"min_distance": 0.3, "stop_count": 30},
        {"min_distance": 0.5, "maximal": True},
        {"count": 60, "exact": True},
        {"count": [150, 30], "order": "progressive"},
        {"count": [150, 200], "order": "progressive", "levels": 3, "level_factor": 1.5},
        {"min_distance": 0.4, "order": "farthest"},
        {"min_distance": 0.4, "classes": 2},
        {"min_distance": 0.3, "metric": "euclidean"},
        {"count": [60, 80], "features": 30},
    ],
)
def test_all_parameters_are_those_of_sample(options):
    meshes = [geodisk.Mesh(CUBE, SIDES), geodisk.Mesh(VERTICES, FACES)]
    found = geodisk.sample_many(meshes, seed=[4, 4], **options)
    for i, samples in enumerate(found):
        own = {name: x[i] if isinstance(x, list) else x for name, x in options.items()}
        alone = geodisk.sample(meshes[i], seed=4, **own)
        assert np.array_equal(samples.points, alone.points)
        assert samples.columns.keys() == alone.columns.keys()
        assert all(np.array_equal(samples.columns[x], alone.columns[x]) for x in alone.columns)
        for name in ("tries", "levels", "corners", "corners_left_out", "cut", "missing", "rho"):
            assert samples.report.get(name) == alone.report.get(name)


def test_what_is_wrong_is_refused():
    with pytest.raises(geodisk.InvalidArgument, match="^mesh 1: metric=.euclidean. and density exclude"):
        geodisk.sample_many(
            [MESHES[0]] * 2,
            min_distance=0.5,
            metric="euclidean",
            density=[None, np.linspace(1, 2, len(VERTICES))],
        )
    with pytest.raises(TypeError, match="unexpected keyword argument 'min_dist'"):
        geodisk.sample_many(MESHES, min_dist=0.5)
    with pytest.raises(geodisk.InvalidArgument, match="which needs a pool of 2e[+]10"):
        geodisk.sample_many(MESHES, count=1e9)
    with pytest.raises(geodisk.InvalidArgument, match="needs a pool of 2e[+]10 candidates"):
        geodisk.sample(MESHES[0], count=10**9, exact=True)


def test_errors_of_the_system_keep_their_number_and_file():
    with pytest.raises(FileNotFoundError, match="mesh 1: No such file") as caught:
        geodisk.sample_many([TETRAHEDRON, "nowhere.obj"], min_distance=1)
    assert (caught.value.errno, caught.value.filename) == (2, "nowhere.obj")


def test_all_warnings_name_the_mesh():
    square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    turned = (square, [[0, 1, 2], [0, 3, 2]])  # One triangle faces the other way.
    with pytest.warns(geodisk.GeodiskWarning) as heard:
        geodisk.sample_many(
            [TETRAHEDRON, turned],
            min_distance=0.2,
            density=[np.full(4, 7), None],
            face_mask=[None, [0, 1]],
        )
    assert sorted((one.message.kind, str(one.message)[:8]) for one in heard) == [
        ("constant_density", "mesh 0: "),
        ("inconsistent_orientation", "mesh 1: "),
        ("mask_of_all", "mesh 1: "),
    ]


def test_points_to_avoid():
    points = (([0], [[0.25, 0.5, 0.25]]), 0.9)
    a, b = geodisk.sample_many([MESHES[0]] * 2, min_distance=0.3, avoid=[points, None])
    assert same(a, geodisk.sample(MESHES[0], min_distance=0.3, avoid=points))
    assert same(b, geodisk.sample(MESHES[0], min_distance=0.3)) and len(a) < len(b)
    with pytest.raises(ValueError, match="mesh 1: avoid has no samples"):
        geodisk.sample_many([MESHES[0]] * 2, min_distance=0.3, avoid=[None, (([], np.empty((0, 3))), 1)])


@pytest.mark.parametrize(
    "meshes, arguments, kind, text",
    [
        ([TETRAHEDRON, (CUBE, [[0, 1, 9]])], {"min_distance": 1}, geodisk.MeshRejected, "mesh 1: "),
        ([TETRAHEDRON, "nowhere.obj"], {"min_distance": 1}, OSError, "mesh 1: .*nowhere.obj"),
        ([CUBE], {"min_distance": 1}, TypeError, "mesh 0: "),
        ([TETRAHEDRON] * 2, {"min_distance": [1]}, ValueError, "1 values for 2 meshes"),
        ([TETRAHEDRON] * 2, {"min_distance": [1, -1]}, ValueError, "mesh 1: the minimum distance"),
        ([TETRAHEDRON], {"count": 9, "radius": 1}, ValueError, "one of"),
        ([TETRAHEDRON], {"count": 9, "density": [[1, 1]]}, ValueError, "mesh 0: density"),
        ([TETRAHEDRON], {"count": 9, "density": []}, ValueError, "0 arrays for 1 meshes"),
        ([TETRAHEDRON] * 2, {"count": 9, "face_mask": [0, 1]}, ValueError, "mesh 0: face_mask is 0, neither"),
    ],
)
def test_wrong_ones_are_named(meshes, arguments, kind, text):
    with pytest.raises(kind, match=text):
        geodisk.sample_many(meshes, **arguments)
