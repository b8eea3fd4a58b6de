"""Samples on corners and curves."""

import geodisk
import numpy as np
import pytest
from meshes import FACES, VERTICES

CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
SIDES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]


def test_a_mesh_without_features_is_warned_of():
    with pytest.warns(geodisk.GeodiskWarning, match="turns by more than 150 degrees .* no features"):
        geodisk.sample(VERTICES, FACES, min_distance=0.5, features=150)


def test_a_cube_has_its_corners_and_edges(tmp_path):
    samples = geodisk.sample(CORNERS, SIDES, min_distance=0.1, features=30)
    feature = samples.columns["feature"]
    assert feature[:8].tolist() == [2] * 8 and np.count_nonzero(feature == 2) == 8
    assert {tuple(p) for p in samples.points[:8]} == {tuple(p) for p in CORNERS}
    on_curves = samples.points[feature == 1]
    assert 75 < len(on_curves) < 100  # Of 120 distances.
    assert (np.count_nonzero((on_curves == 0) | (on_curves == 1), axis=1) == 2).all()
    assert geodisk.verify(samples).ok
    assert samples.report["corners"] == 8 and samples.report["corners_left_out"] == 0
    assert "existing" not in samples.columns
    samples.save(tmp_path / "a.ply")
    assert np.array_equal(geodisk.read(tmp_path / "a.ply").columns["feature"], feature)


def test_with_a_count_existing_samples_and_few_corners():
    samples = geodisk.sample(CORNERS, SIDES, count=400, features=30)
    assert abs(len(samples) - 400) <= 20
    more = geodisk.sample(CORNERS, SIDES, min_distance=0.1, features=30, existing=samples[100:103])
    assert more.columns["existing"].tolist()[:4] == [1, 1, 1, 0]
    assert more.columns["feature"].tolist()[:4] == [0, 0, 0, 2]
    few = geodisk.sample(CORNERS, SIDES, min_distance=1.2, features=30)
    assert few.report["corners_left_out"] == 8 - few.report["corners"] > 0
    smooth = geodisk.sample(CORNERS, SIDES, min_distance=0.1, features=90)
    assert smooth.columns["feature"].sum() == 0


def test_wrong_ones_are_refused():
    for options, text in (
        ({"features": 0}, "not an angle from 1 to 180"),
        ({"features": float("nan")}, "not an angle from 1 to 180"),
    ):
        with pytest.raises(geodisk.InvalidArgument, match=text):
            geodisk.sample(CORNERS, SIDES, min_distance=0.1, **options)


def test_many_meshes_have_the_features_of_each():
    fold = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 1, 1], [1, 1, 1]]
    meshes = [geodisk.Mesh(CORNERS, SIDES), geodisk.Mesh(fold, [[0, 1, 2, 3], [3, 2, 5, 4]])]
    own = geodisk.sample(meshes[0], min_distance=0.1)[50:53]
    factors = np.linspace(0.5, 1, 8)
    for options, each in (
        (dict(min_distance=[0.1, 0.07], seed=[1, 2]), {}),
        (dict(count=[300, 200]), {}),
        (dict(count=[300, 200], exact=True), {}),
        (dict(min_distance=[0.1, 0.1]), dict(existing=[own, None], radius_factor=[factors, None])),
    ):
        found = geodisk.sample_many(meshes, features=30, **options, **each)
        for i, (mesh, there) in enumerate(zip(meshes, found)):
            of_mesh = {name: x if x is True else x[i] for name, x in {**options, **each}.items()}
            alone = geodisk.sample(mesh, features=30, **of_mesh)
            assert np.array_equal(there.points, alone.points) and len(there) > 100
            assert there.min_distance == alone.min_distance
            assert there.columns.keys() == alone.columns.keys()
            for name, column in alone.columns.items():
                assert np.array_equal(there.columns[name], column), name
            assert 0 < np.count_nonzero(there.columns["feature"]) < len(there)
            assert there.report["corners"] == alone.report["corners"]
    with pytest.raises(geodisk.InvalidArgument, match="not an angle from 1 to 180"):
        geodisk.sample_many(meshes, min_distance=0.1, features=0)
    with pytest.raises(geodisk.InvalidArgument, match="mesh 0: features and density exclude"):
        geodisk.sample_many(meshes, min_distance=0.1, features=30, density=[np.ones(8), None])
