"""Farthest-point order."""

import numpy as np
import pytest

import geodisk
from meshes import torus


@pytest.fixture(scope="module")
def samples():
    return geodisk.sample(*torus(), count=200)


def test_each_is_the_farthest(samples):
    order = geodisk.farthest_order(samples)
    assert len(order) == len(samples) and order.cover == 0
    assert sorted(order.indices) == list(range(len(samples)))
    assert order.indices[0] == 0 and np.isinf(order.distances[0])
    near = geodisk.neighbours(*torus(), samples, within=100.0, among="sources")
    distances = np.full(len(samples), np.inf)
    for index, distance in zip(order.indices, order.distances):
        assert distance == pytest.approx(distances.max(), abs=1e-5)
        found, lengths = near[int(index)]
        distances[found] = np.minimum(distances[found], lengths)
        distances[index] = -1


def test_the_first_ones(samples):
    few = geodisk.farthest_order(samples, count=20)
    assert np.array_equal(few.indices, geodisk.farthest_order(samples).indices[:20])
    assert 0 < few.cover <= few.distances[-1]
    chosen = samples[few.indices]
    assert geodisk.verify(chosen, min_distance=float(few.distances[-1]) * 0.9999)


def test_samples_come_in_that_order(samples):
    far = geodisk.sample(*torus(), count=200, order="farthest")
    order = geodisk.farthest_order(samples)
    assert np.array_equal(far.points, samples.points[order.indices])
    assert np.array_equal(far.attributes["cover"], order.distances)
    assert np.array_equal(far.attributes["row"], order.indices)
    assert np.array_equal(far.order, order.indices)


def test_goes_on_from_existing_samples(samples):
    more = geodisk.sample(*torus(), count=300, order="farthest", existing=samples[:50])
    assert np.array_equal(more.points[:50], samples.points[:50])
    cover = more.attributes["cover"]
    assert np.isinf(cover[:50]).all() and np.isfinite(cover[50:]).all()
    assert (np.diff(cover[50:]) <= 0).all()
    order = geodisk.farthest_order(more[50:], existing=samples[:50], count=60)
    assert np.array_equal(order.indices, np.arange(60))
    assert np.array_equal(order.distances, cover[50:110].astype(np.float32))
    assert order.cover == pytest.approx(cover[110])
    points = samples.points[:50]
    assert np.array_equal(geodisk.farthest_order(more[50:], existing=points).indices[:9], range(9))


def test_begins_with_any(samples):
    order = geodisk.farthest_order(samples, start=7)
    assert order.indices[0] == 7 and np.isinf(order.distances[0])
    assert sorted(order.indices) == list(range(len(samples)))


def test_samples_from_a_file(samples, tmp_path):
    samples.save(tmp_path / "a.npz")
    again = geodisk.read(tmp_path / "a.npz")
    with pytest.raises(geodisk.InvalidArgument, match="do not know their mesh"):
        geodisk.farthest_order(again)
    mesh = geodisk.Mesh(*torus())
    found = geodisk.farthest_order(again, mesh, count=9)
    assert np.array_equal(found.indices, geodisk.farthest_order(samples, count=9).indices)


def test_what_is_refused(samples):
    for count in (0, 10**6):
        with pytest.raises(geodisk.InvalidArgument, match=f"count is {count}, not from 1 to"):
            geodisk.farthest_order(samples, count=count)
    with pytest.raises(geodisk.InvalidArgument, match="box"):
        geodisk.farthest_order(geodisk.sample_box([1, 1], count=9))
    for start in (-1, 10**6):
        with pytest.raises(geodisk.InvalidArgument, match=f"start is {start}"):
            geodisk.farthest_order(samples, start=start)
    with pytest.raises(geodisk.InvalidArgument, match="start and existing exclude each other"):
        geodisk.farthest_order(samples, start=3, existing=samples[:2])
    with pytest.raises(geodisk.Cancelled, match="returned False"):
        geodisk.farthest_order(samples, progress=lambda *_: False)
    with pytest.raises(ZeroDivisionError):
        geodisk.farthest_order(samples, progress=lambda *_: 1 // 0)


def test_only_true_and_false_are_flags(samples):
    for name in ("maximal", "exact", "keep_seams"):
        with pytest.raises(TypeError, match=f"{name} is 'no', neither True nor False"):
            geodisk.sample(*torus(), count=50, **{name: "no"})
    with pytest.raises(TypeError, match="periodic is 1,"):
        geodisk.sample_box([1, 1], count=9, periodic=1)
    with pytest.raises(TypeError, match="maximal"):
        geodisk.verify(samples, maximal="no")
    for name in ("each", "return_nearest"):
        with pytest.raises(TypeError, match=f"{name} is 2,"):
            geodisk.geodesic_distances(*torus(), 0, **{name: 2})
    with pytest.raises(TypeError, match="legend"):
        geodisk.render(samples, legend="no")
    with pytest.raises(TypeError, match="progress is 'yes'"):
        geodisk.sample(*torus(), count=50, progress="yes")
    assert len(geodisk.sample_box([1, 1], count=9, periodic=np.bool_(True))) > 0
