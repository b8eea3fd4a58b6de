"""Samples that follow edits are those of whole runs."""

import dataclasses
import pickle

import numpy as np
import pytest

import geodisk
from meshes import FACES, SOUP, VERTICES, same, torus

SAMPLES = geodisk.sample(VERTICES, FACES, min_distance=0.3, seed=5)
MASK = np.arange(len(FACES)) % 3 != 0


def moved():
    edited = VERTICES * 1.0
    edited[0] *= 1.1
    return edited


def whole(vertices=VERTICES, **options):
    return geodisk.sample(vertices, FACES, min_distance=0.3, seed=5, **options)


def test_vertices_that_move():
    there = geodisk.update(SAMPLES, moved())
    assert same(there, whole(moved())) and np.array_equal(there.points, whole(moved()).points)
    assert there.seed == 5 and there.min_distance == 0.3
    assert there.report["update"]["rounds"] > 0
    same_mesh = geodisk.update(SAMPLES, VERTICES)
    assert np.array_equal(same_mesh.points, SAMPLES.points)
    assert same_mesh.report["update"] == dict(rounds=0, faces=0, uploaded=0, removed=0, added=0)
    again = geodisk.update(there, VERTICES)
    assert np.array_equal(again.points, SAMPLES.points)
    soup = geodisk.sample(*SOUP, min_distance=0.5, weld=True)
    assert same(geodisk.update(soup, SOUP[0]), soup)


def test_samples_of_files_need_their_mesh(tmp_path):
    SAMPLES.save(tmp_path / "a.ply")
    read = geodisk.read(tmp_path / "a.ply")
    with pytest.raises(geodisk.InvalidArgument, match="mesh"):
        geodisk.update(read, moved())
    there = geodisk.update(read, moved(), vertices=VERTICES, faces=FACES)
    assert same(there, whole(moved()))


def test_masks_and_existing_samples():
    masked = whole(face_mask=MASK)
    assert same(geodisk.update(SAMPLES, face_mask=MASK), masked)
    assert same(geodisk.update(masked, face_mask=np.ones(len(FACES), bool)), SAMPLES)
    assert same(geodisk.update(masked, moved()), whole(moved(), face_mask=MASK))
    given = ([3, 70], [[0.25, 0.5, 0.25], [0.5, 0.25, 0.25]])
    kept = whole(existing=given)
    there = geodisk.update(SAMPLES, existing=given)
    assert same(there, kept) and there.columns["given"].sum() == 2
    assert same(geodisk.update(there, existing=([], [])), SAMPLES)
    assert same(geodisk.update(kept, moved()), whole(moved(), existing=given))
    own = whole(existing=SAMPLES[:2])
    assert np.array_equal(geodisk.update(own, moved()).face_index[:2], own.face_index[:2])


def test_points_to_avoid():
    avoid = (SAMPLES[:2], [0.9, 0.2])
    clear = whole(avoid=avoid)
    assert same(geodisk.update(SAMPLES, avoid=avoid), clear) and not same(clear, SAMPLES)
    places = SAMPLES.face_index[:2], SAMPLES.barycentric[:2]
    there = geodisk.update(clear, moved())
    assert same(there, whole(moved(), avoid=(places, avoid[1])))
    assert same(geodisk.update(there, VERTICES, avoid=(([], []), 1)), SAMPLES)
    assert there.report["options"] == ["avoid"]


def test_radii_and_pools(tmp_path):
    factors = 0.6 + 0.4 * (VERTICES[:, 0] > 0)
    varied = whole(radius_factor=factors)
    painted = factors.copy()
    painted[:3] = 0.5
    assert same(geodisk.update(varied, radius_factor=painted), whole(radius_factor=painted))
    assert same(geodisk.update(varied, moved()), whole(moved(), radius_factor=factors))
    density = 1 + 3.0 * (VERTICES[:, 0] > 0)
    dense = geodisk.sample(VERTICES, FACES, count=400, seed=5, density=density)
    painted = density.copy()
    painted[:3] = 2
    there = geodisk.update(dense, density=painted)
    assert there.min_distance == dense.min_distance
    same_distance = geodisk.sample(
        VERTICES, FACES, min_distance=dense.min_distance, seed=5, density=painted
    )
    assert same(there, same_distance)
    sparse = whole(pool_ratio=5)
    assert same(geodisk.update(sparse, moved()), whole(moved(), pool_ratio=5))
    # Files and pickles do not have the values.
    sparse.save(tmp_path / "sparse.csv")
    surface = {"vertices": VERTICES, "faces": FACES}
    for other in (geodisk.read(tmp_path / "sparse.csv"), pickle.loads(pickle.dumps(sparse))):
        with pytest.raises(geodisk.InvalidArgument, match="give before={'pool_ratio': ...}"):
            geodisk.update(other, moved(), **surface)
        there = geodisk.update(other, moved(), before={"pool_ratio": 5}, **surface)
        assert same(there, whole(moved(), pool_ratio=5))


def test_keys_find_faces_that_are_elsewhere():
    keys = np.arange(len(FACES)) + 7
    keyed = whole(face_keys=keys)
    turned = np.ascontiguousarray(np.asarray(FACES)[::-1])
    there = geodisk.update(keyed, VERTICES, turned, face_keys=keys[::-1])
    expected = geodisk.sample(
        VERTICES, turned, min_distance=0.3, seed=5, face_keys=keys[::-1]
    )
    assert same(there, expected)
    assert there.report["update"]["rounds"] == 0


@pytest.mark.filterwarnings("ignore::geodisk.MeshWarning")
def test_what_cannot_be_updated_is_refused():
    def refused(match, samples=SAMPLES, *arguments, kind=geodisk.InvalidArgument, **options):
        with pytest.raises(kind, match=match):
            geodisk.update(samples, *arguments, **options)

    edited = moved()
    refused("is no candidate", dataclasses.replace(SAMPLES, seed=6), edited)
    refused("do not know their seed", dataclasses.replace(SAMPLES, seed=None), edited)
    refused("removed, added or changed", SAMPLES[::2], edited)
    refused("removed, added or changed", SAMPLES[[0, *range(len(SAMPLES) - 1)]], edited)
    assert same(geodisk.update(SAMPLES[::-1], edited), whole(edited))
    refused("made with stop_count cannot", whole(stop_count=20), edited)
    many = geodisk.sample_many([(VERTICES, FACES)], min_distance=0.3)
    refused("made with sample_many cannot", many[0])
    refused("not made 0.2 apart", dataclasses.replace(SAMPLES, min_distance=0.2), edited)
    refused("made with maximal cannot", whole(maximal=True), edited)
    refused("radii", SAMPLES, radius_factor=np.full(len(VERTICES), 0.5))
    refused("not from 0.001 to 1|below 0.001|nan", whole(radius_factor=np.ones(len(VERTICES))),
            radius_factor=np.full(len(VERTICES), np.nan))
    refused("none of", kind=TypeError, before={"seed": 1})
    refused("to_faces", kind=TypeError, to_faces=FACES)
    refused("no mesh", geodisk.sample_box([1, 1], min_distance=0.2))
    refused("edge", SAMPLES, VERTICES * [1, 1, 1000])
    other = torus(9, 9)
    refused("face|mesh", SAMPLES, edited, vertices=other[0], faces=other[1])
    with pytest.raises(geodisk.Cancelled):
        geodisk.update(SAMPLES, edited, progress=lambda part, count: False)
