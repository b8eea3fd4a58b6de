"""Classes of samples."""

import geodisk
import numpy as np
import pytest

from meshes import FACES, VERTICES, same


def test_classes_keep_their_distances(tmp_path):
    samples = geodisk.sample(VERTICES, FACES, min_distance=0.6, classes=3)
    counts = np.bincount(samples.classes)
    assert len(counts) == 3 and counts.min() > 20
    assert samples.class_distances[0, 1] == pytest.approx(0.6 / np.sqrt(3))
    found = geodisk.verify(samples)
    assert found.ok and found.smallest_ratio >= 1
    assert not geodisk.verify(samples, min_distance=0.6).ok
    for name in ("a.ply", "a.csv", "a.npz"):
        samples.save(tmp_path / name)
        again = geodisk.read(tmp_path / name)
        assert np.array_equal(again.classes, samples.classes)
        assert np.allclose(again.class_distances, samples.class_distances)
        assert geodisk.verify(again, VERTICES, FACES).ok
    assert samples[:5].classes.tolist() == samples.classes[:5].tolist()
    plain = geodisk.sample(VERTICES, FACES, min_distance=0.6)
    one = geodisk.sample(VERTICES, FACES, min_distance=0.6, classes=1)
    assert same(one, plain) and plain.classes is None and one.classes.sum() == 0


def test_a_table_has_all_distances():
    table = [[0.6, 0.3], [0.3, 0.4]]
    samples = geodisk.sample(VERTICES, FACES, classes=table, seed=4)
    assert samples.min_distance == 0.6 and geodisk.verify(samples).ok
    few, many = np.bincount(samples.classes)
    assert 1.5 < many / few < 4
    again = geodisk.sample(VERTICES, FACES, classes=table, seed=4, existing=samples[:40])
    assert same(again, samples) and np.array_equal(again.classes, samples.classes)
    radii = np.array([0.3, 0.2])[samples.classes]
    assert np.array_equal(samples.radius, radii) and samples[3].radius == radii[3]
    made = geodisk.Samples(
        face_index=samples.face_index,
        barycentric=samples.barycentric,
        columns={"class": samples.classes},
        class_distances=table,
    )
    assert np.array_equal(made.radius, radii)
    moved = geodisk.transfer(samples, 2 * VERTICES)
    assert moved.class_distances is None and np.ptp(moved.radius) == 0
    samples.classes[:] = 0
    assert not geodisk.verify(samples).ok


def test_a_count_is_that_of_all_classes():
    samples = geodisk.sample(VERTICES, FACES, count=600, classes=2)
    assert abs(len(samples) - 600) <= 30


def test_a_count_scales_the_table(tmp_path):
    samples = geodisk.sample(VERTICES, FACES, classes=[[4, 2], [2, 1]], count=300, exact=True)
    assert len(samples) == 300 and len(np.unique(samples.classes)) == 2
    distance = samples.min_distance
    assert np.allclose(samples.class_distances, np.array([[4, 2], [2, 1]]) * distance / 4)
    assert geodisk.verify(samples)
    samples.save(tmp_path / "a.csv")
    assert geodisk.verify(geodisk.read(tmp_path / "a.csv"), VERTICES, FACES)


def test_two_classes_may_keep_no_distance(tmp_path):
    samples = geodisk.sample(VERTICES, FACES, count=300, classes=[[1, 0], [0, 1]])
    assert geodisk.verify(samples)
    near = geodisk.neighbours(
        VERTICES, FACES, samples, within=0.5 * samples.min_distance, among="sources"
    )
    first, second = np.repeat(np.arange(len(samples)), np.diff(near.offsets).astype(int)), near.indices
    assert len(first) > 0
    assert (samples.classes[first] != samples.classes[second]).all()
    samples.save(tmp_path / "a.csv")
    assert geodisk.verify(geodisk.read(tmp_path / "a.csv"), VERTICES, FACES)


def test_each_class_has_a_number():
    table = [[0.4, 0.3], [0.3, 0.2]]
    every = geodisk.sample(VERTICES, FACES, classes=table)
    few = geodisk.sample(VERTICES, FACES, classes=table, class_counts=[5, 30])
    assert np.array_equal(np.bincount(few.classes), [5, 30])
    for number, count in enumerate((5, 30)):
        first = every.points[every.classes == number][:count]
        assert np.array_equal(few.points[few.classes == number], first)
    assert geodisk.verify(few)
    with pytest.warns(geodisk.GeodiskWarning, match="class 0 has [0-9]+ of 5000 samples"):
        geodisk.sample(VERTICES, FACES, classes=table, class_counts=[5000, 30])
    for counts, text in (
        ([5], r"has the shape \(1,\), not \(2,\)"),
        ([5, 0], "other numbers than whole ones"),
        ([5, 2.5], "other numbers than whole ones"),
    ):
        with pytest.raises(geodisk.InvalidArgument, match=text):
            geodisk.sample(VERTICES, FACES, classes=table, class_counts=counts)
    with pytest.raises(geodisk.InvalidArgument, match="two or more"):
        geodisk.sample(VERTICES, FACES, min_distance=0.4, class_counts=[5])
    many = geodisk.sample_many([(VERTICES, FACES)] * 2, classes=table, class_counts=[5, 30])
    assert np.array_equal(many[1].points, few.points)


def test_classes_have_places_of_their_own():
    mesh = geodisk.Mesh(VERTICES, FACES)
    mask = np.arange(len(mesh.triangles)) % 2 == 0
    density = np.zeros(len(VERTICES))
    density[FACES[0]] = 1
    point = geodisk.sample(mesh, count=20).points[:1]
    places = {
        "class_masks": {0: mask},
        "class_densities": {1: density},
        "class_avoid": {2: (point, 1.0)},
    }
    samples = geodisk.sample(mesh, min_distance=0.2, classes=3, **places)
    assert np.bincount(samples.classes, minlength=3).min() > 0 and geodisk.verify(samples)
    assert mask[samples.face_index[samples.classes == 0]].all()
    assert not mask[samples.face_index].all()
    near = (density[mesh.triangles] > 0).any(axis=1)
    assert near[samples.face_index[samples.classes == 1]].all()
    assert geodisk.verify(samples[samples.classes == 2], mesh, avoid=(point, 1.0))
    assert not geodisk.verify(samples, mesh, avoid=(point, 1.0))
    many = geodisk.sample_many(
        [mesh] * 2, min_distance=0.2, classes=3, **{name: [one, None] for name, one in places.items()}
    )
    plain = geodisk.sample(mesh, min_distance=0.2, classes=3)
    assert same(many[0], samples) and same(many[1], plain)
    for option, text in (
        ({"class_masks": {3: mask}}, "the class of class_masks is 3, not from 0 to 2"),
        ({"class_masks": {0: mask & False}}, "class 0 may lie nowhere"),
        ({"class_densities": {0: density - 1}}, r"class_densities\[0\] is -1.0 at vertex"),
        ({"class_densities": {0: density * 0}}, r"class_densities\[0\] is 0 everywhere"),
    ):
        with pytest.raises(geodisk.InvalidArgument, match=text):
            geodisk.sample(mesh, min_distance=0.2, classes=3, **option)
    with pytest.raises(geodisk.InvalidArgument, match="class_masks is for classes, two or more"):
        geodisk.sample(mesh, min_distance=0.2, class_masks={0: mask})
    with pytest.warns(geodisk.GeodiskWarning, match="class 0 has no sample"):
        geodisk.sample(
            mesh, min_distance=0.2, classes=2, class_masks={0: mask}, face_mask=~mask
        )
    assert same(geodisk.sample(mesh, min_distance=0.2, class_masks={}),
                geodisk.sample(mesh, min_distance=0.2))
    with pytest.raises(TypeError, match="class_avoid is a dict"):
        geodisk.sample(mesh, min_distance=0.2, classes=3, class_avoid=[(point, 1.0)])


def test_wrong_ones_are_refused():
    samples = geodisk.sample(VERTICES, FACES, min_distance=0.6, classes=3)
    for options, text in (
        ({"classes": 0}, "not a number from 1 to 8"),
        ({"classes": 2.5}, "not a number from 1 to 8"),
        ({"classes": np.nan}, "not a number from 1 to 8"),
        ({"classes": np.inf}, "not a number from 1 to 8"),
        ({"classes": []}, "has the shape"),
        ({"classes": np.ones((9, 9))}, "has the shape"),
        ({"classes": [[1, 2], [3, 1]]}, "not symmetric"),
        ({"classes": [[1, -2], [-2, 1]]}, "are negative"),
        ({"classes": [[1, 1], [1, 0]]}, "keeps no distance from itself"),
        ({"classes": [[1, 0.001], [0.001, 1]]}, "factor of 100"),
        ({"classes": [[1, 1], [1, 1]], "min_distance": 1}, "takes no min_distance"),
        ({"classes": [[1, 1], [1, 1]], "radius": 1}, "takes no min_distance and no radius"),
        ({"classes": 2, "min_distance": 0.6, "existing": samples}, "has class 2"),
    ):
        with pytest.raises(geodisk.InvalidArgument, match=text):
            geodisk.sample(VERTICES, FACES, **options)
    with pytest.raises(TypeError, match=r"class_avoid\[1\] is a pair"):
        geodisk.sample(VERTICES, FACES, min_distance=0.6, classes=2, class_avoid={1: VERTICES})


def test_existing_samples_without_classes_get_the_first_one_with_a_warning():
    existing = geodisk.sample(VERTICES, FACES, min_distance=0.9)[:2]
    with pytest.warns(geodisk.GeodiskWarning, match="^mesh 1: existing: the samples have no class"):
        made = geodisk.sample_many(
            [(VERTICES, FACES)] * 2, min_distance=0.6, classes=2, existing=[None, existing]
        )
    assert made[1].classes[:2].tolist() == [0, 0]
