"""Many meshes as one job: the samples of each by itself."""

import importlib

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


@pytest.mark.parametrize("limit, value", [("_RUN_FACES", 2 * len(FACES)), ("_RUN_CANDIDATES", 300)])
def test_many_take_several_jobs(monkeypatch, limit, value):
    many = importlib.import_module("geodisk._many")
    jobs = []
    make = many._domain
    monkeypatch.setattr(many, "_domain", lambda group: jobs.append(len(group)) or make(group))
    monkeypatch.setattr(many, limit, value)
    meshes = [MESHES[0]] * 5
    found = geodisk.sample_many(meshes, min_distance=0.6, seed=[1, 2, 1, 3, 1])
    assert len(jobs) > 1 and sum(jobs) == 5
    for seed, samples in zip([1, 2, 1, 3, 1], found):
        assert same(samples, geodisk.sample(MESHES[0], min_distance=0.6, seed=seed))


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


def test_what_is_of_one_mesh_is_refused():
    for name, value in (("classes", 2), ("maximal", True), ("stop_count", 9), ("order", "progressive")):
        with pytest.raises(TypeError, match=f"takes no {name}; call sample.. for each mesh"):
            geodisk.sample_many(MESHES, min_distance=0.5, **{name: value})
    with pytest.raises(TypeError, match="unexpected keyword argument 'min_dist'"):
        geodisk.sample_many(MESHES, min_dist=0.5)
    with pytest.raises(geodisk.InvalidArgument, match="which needs a pool of 2e[+]10"):
        geodisk.sample_many(MESHES, count=1e9)
    with pytest.raises(geodisk.InvalidArgument, match="needs a pool of 2e[+]10 candidates"):
        geodisk.sample(MESHES[0], count=10**9, exact=True)


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
    ],
)
def test_wrong_ones_are_named(meshes, arguments, kind, text):
    with pytest.raises(kind, match=text):
        geodisk.sample_many(meshes, **arguments)
