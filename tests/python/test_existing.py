"""Samples that a run keeps."""

import geodisk
import numpy as np
import pytest

from meshes import FACES, VERTICES, same


def first(samples, count):
    """Triangles and weights of the first ones."""
    return samples.face_index[:count], samples.barycentric[:count]


def test_a_run_goes_on_from_its_own_samples():
    whole = geodisk.sample(VERTICES, FACES, min_distance=0.3)
    assert "existing" not in whole.columns and whole.report["existing"] == 0
    for existing in (whole[:20], first(whole, 20)):
        again = geodisk.sample(VERTICES, FACES, min_distance=0.3, existing=existing)
        assert same(again, whole)
        assert again.report["existing"] == 20
        assert again.columns["existing"].tolist() == [1] * 20 + [0] * (len(whole) - 20)
    kept = again[15:25]
    assert kept.columns["existing"].sum() == 5 and kept[0].columns["existing"] == 1


def test_existing_samples_are_told_apart(tmp_path):
    sparse = geodisk.sample(VERTICES, FACES, min_distance=0.6, seed=4)
    samples = geodisk.sample(VERTICES, FACES, min_distance=0.3, existing=sparse)
    assert np.array_equal(samples.points[: len(sparse)], sparse.points)
    assert geodisk.verify(samples).existing == len(sparse)
    dense = geodisk.sample(VERTICES, FACES, min_distance=0.2, seed=4)
    crowded = geodisk.sample(VERTICES, FACES, min_distance=0.3, existing=dense)
    found = geodisk.verify(crowded)
    assert found.ok and len(found.violations) == 0
    assert found.existing == len(dense) and len(found.existing_violations) > 0
    crowded.save(tmp_path / "a.ply")
    again = geodisk.read(tmp_path / "a.ply")
    assert np.array_equal(again.columns["existing"], crowded.columns["existing"])
    assert geodisk.verify(crowded[len(dense) :]).existing == 0


def test_each_of_many_meshes_has_its_own():
    whole = geodisk.sample(VERTICES, FACES, min_distance=0.3, seed=2)
    a, b = geodisk.sample_many(
        [(VERTICES, FACES)] * 2, min_distance=0.3, seed=[1, 2], existing=[None, whole[:9]]
    )
    assert same(b, whole) and b.columns["existing"].sum() == 9
    assert "existing" not in a.columns


def test_a_count_has_the_existing_ones_in_it():
    existing = geodisk.sample(VERTICES, FACES, min_distance=0.6)
    samples = geodisk.sample(VERTICES, FACES, count=300, existing=existing)
    assert abs(len(samples) - 300) <= 15
    some = geodisk.sample(
        VERTICES, FACES, min_distance=0.3, stop_count=len(existing) + 5, existing=existing
    )
    assert len(some) == len(existing) + 5


def test_wrong_ones_are_refused():
    whole = geodisk.sample(VERTICES, FACES, min_distance=0.3)

    def refuses(text, existing, error=geodisk.InvalidArgument, **options):
        with pytest.raises(error, match=text):
            geodisk.sample(VERTICES, FACES, existing=existing, **{"min_distance": 0.3, **options})

    refuses("existing: 5 points lie farther off the mesh", geodisk.Samples(whole.points[:5] + 1))
    refuses("existing: samples in a box", geodisk.sample_box([1, 1, 1], min_distance=0.5))
    refuses("has no samples", whole[:0])
    refuses("a geodisk.Samples, an array of coordinates, or a pair", whole.points[0], TypeError)
    refuses("existing: .*off the mesh", whole.points + 1)
    refuses(r"existing: points have the shape \(\d+, 1\)", whole.points[:, :1])
    refuses("existing sample 1 is in face 1000000", ([0, 1000000], [[1, 0, 0], [1, 0, 0]]))
    refuses("existing sample 0 has weights", ([0], [[1, 1, 0]]))
    refuses("existing sample 0 has weights", ([0], [[np.nan, 1, 0]]))
    refuses("shape", ([0, 1], [[1, 0, 0]]))
    refuses("stop count", whole, stop_count=3)
    refuses("count too", whole, min_distance=None, count=10)
    other = geodisk.Samples(
        whole.points + 1, face_index=whole.face_index, barycentric=whole.barycentric
    )
    refuses("existing: sample 0 is .* are these samples of another mesh", other)


def test_no_room_is_warned_of():
    corner = geodisk.Samples([VERTICES[FACES[0][0]]], face_index=[0], barycentric=[[1, 0, 0]])
    with pytest.warns(geodisk.GeodiskWarning, match="no sample fits outside the points") as told:
        none = geodisk.sample(VERTICES, FACES, min_distance=0.3, avoid=(corner, 100))
    assert len(none) == 0 and len(told) == 1
    with pytest.warns(geodisk.GeodiskWarning, match="mesh 1: no new sample fits beside"):
        some, one = geodisk.sample_many(
            [(VERTICES, FACES)] * 2, min_distance=[0.3, 100], existing=[None, corner]
        )
    assert len(some) > 1 and len(one) == 1


def test_points_are_avoided():
    center = geodisk.Samples(face_index=[100], barycentric=[[0.5, 0.25, 0.25]])
    where = VERTICES[FACES[100]].T @ [0.5, 0.25, 0.25]
    samples = geodisk.sample(VERTICES, FACES, min_distance=0.2, avoid=(center, 0.9))
    away = np.linalg.norm(samples.points - where, axis=1)
    assert 0.6 < away.min() < 1.2  # A straight line is shorter.
    assert len(samples) < len(geodisk.sample(VERTICES, FACES, min_distance=0.2))
    two = [100, 500], [[0.5, 0.25, 0.25]] * 2
    both = geodisk.sample(VERTICES, FACES, min_distance=0.2, avoid=(two, [0.9, 0.5]))
    assert len(both) < len(samples)
    for wrong, text in (
        ((two, [1, 2, 3]), "radii of the shape"),
        ((two, 0), "point to avoid 0 has the radius 0"),
        ((two, [1, np.nan]), "point to avoid 1 has the radius"),
        ((([10**6], [[1, 0, 0]]), 1), "point to avoid 0 is in face"),
    ):
        with pytest.raises(geodisk.InvalidArgument, match=text):
            geodisk.sample(VERTICES, FACES, min_distance=0.2, avoid=wrong)
    with pytest.raises(TypeError, match="a pair: points"):
        geodisk.sample(VERTICES, FACES, min_distance=0.2, avoid=1.0)


def test_points_of_other_programs_are_put_on_the_nearest_faces():
    whole = geodisk.sample(VERTICES, FACES, min_distance=0.4, seed=2)[:40]
    normals = whole.normals * np.where(np.arange(40) % 2, 1, -1)[:, None]
    points = geodisk.Samples(whole.points + 1e-3 * normals)
    placed = geodisk.transfer(points, VERTICES, VERTICES, FACES)
    assert np.array_equal(placed.face_index, whole.face_index)
    assert np.allclose(placed.barycentric, whole.barycentric, atol=0.02)
    mesh = geodisk.Mesh(VERTICES, FACES)

    def equal(call, *fields):
        for name in fields:
            assert np.array_equal(getattr(call(points), name), getattr(call(placed), name)), name

    places = "face_index", "barycentric"
    equal(lambda x: geodisk.sample(mesh, min_distance=0.4, existing=x), *places)
    equal(lambda x: geodisk.sample(mesh, min_distance=0.4, avoid=(x, 0.5)), *places)
    equal(lambda x: geodisk.sample_many([mesh], min_distance=0.4, existing=[x])[0], *places)
    equal(lambda x: geodisk.neighbours(mesh, sources=x, within=0.7), "indices", "distances")
    equal(lambda x: geodisk.neighbours(mesh, among=x, nearest=2), "indices", "distances")
    equal(lambda x: geodisk.cells(mesh, x), "area", "triangles")
    equal(lambda x: geodisk.farthest_order(x, mesh), "indices", "distances")
    equal(lambda x: geodisk.verify(whole, mesh, avoid=(x, 0.01)), "within_avoided")
    kept = geodisk.sample(mesh, min_distance=0.4, existing=points, avoid=(points, 0.5))
    moved = VERTICES * 1.0
    moved[0] *= 1.1
    there = geodisk.update(kept, moved)
    assert np.array_equal(there.face_index[:40], whole.face_index)
    assert geodisk.transfer(geodisk.Samples(whole.points + 0.01), VERTICES, mesh, tolerance=0.1)
    with pytest.raises(geodisk.InvalidArgument, match="farther off"):
        geodisk.transfer(geodisk.Samples(whole.points + 0.01), VERTICES, mesh)
