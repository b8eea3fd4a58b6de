"""What is near each vertex or point, along the surface."""

import ctypes

import numpy as np
import pytest

import geodisk
from geodisk import _library, _structs
from geodisk._searching import listened
from meshes import FACES, VERTICES

KNOT = geodisk.Mesh("builtin:torus-knot:8")


def test_vertices_near_vertices():
    near = geodisk.neighbours(KNOT, within=0.3)
    count = len(KNOT.vertices)
    assert len(near) == count and near.sources.tolist() == list(range(count))
    assert near.offsets[-1] == len(near.indices) == len(near.distances)
    table = np.full((count, count), np.inf)
    for source, (found, distances) in zip(near.sources, near):
        assert (np.diff(found.astype(int)) > 0).all() and (distances <= 0.3).all()
        table[source, found] = distances
    assert (np.diag(table) == 0).all()
    both = np.isfinite(table) & np.isfinite(table.T)
    assert np.abs(table[both] - table.T[both]).max() < 1e-5  # From either side.
    straight = np.linalg.norm(KNOT.vertices[:, None] - KNOT.vertices[None], axis=2)
    assert (table >= straight - 1e-5).all()
    assert 0 < near.error < 1e-4 and "pairs" in repr(near)


def test_some_vertices_points_and_each_other():
    near = geodisk.neighbours(KNOT, sources=[9, 3], within=[0.2, 0.4])
    assert near.sources.tolist() == [9, 3] and len(near[0][0]) < len(near[1][0])
    samples = geodisk.sample(KNOT, min_distance=0.3)
    graph = geodisk.neighbours(KNOT, sources=samples, within=0.9, among="sources", nearest=6)
    assert graph.sources is None and len(graph) == len(samples)
    for source, (found, distances) in enumerate(graph):
        assert len(found) <= 6 and source not in found
        assert (distances >= 0.3).all() and (np.diff(distances) >= 0).all()
    places = (samples.face_index[:5], samples.barycentric[:5])
    found = geodisk.neighbours(KNOT, sources=places, within=0.01, among=samples)
    assert found.indices.tolist() == [0, 1, 2, 3, 4] and (found.distances == 0).all()


def test_the_nearest_sample_of_each_vertex():
    samples = geodisk.sample(KNOT, min_distance=0.5)
    near = geodisk.neighbours(KNOT, among=samples, nearest=1)
    assert np.array_equal(near.offsets, np.arange(len(KNOT.vertices) + 1))
    everything = geodisk.neighbours(KNOT, sources=samples, within=100)
    least = np.full(len(KNOT.vertices), np.inf)
    np.minimum.at(least, everything.indices, everything.distances)
    assert np.abs(near.distances - least).max() < 1e-4


def test_all_vertices_of_a_seam_are_found():
    square = [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]]
    near = geodisk.neighbours(square, [[0, 1, 2], [3, 4, 5]], within=1.2, sources=[3])
    assert near[0][0].tolist() == [0, 1, 3, 5]
    with pytest.warns(geodisk.MeshWarning):
        apart = geodisk.neighbours(square, [[0, 1, 2], [3, 4, 5]], within=1.2, keep_seams=True)
    assert apart[3][0].tolist() == [3, 5]


def test_the_nearest_vertices_are_places():
    places = np.array(
        [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], float
    )
    faces = np.array(
        [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]]
    )
    flat = places[faces.ravel()]
    own = geodisk.neighbours(places, faces, nearest=5)
    split = geodisk.neighbours(flat, np.arange(24).reshape(8, 3), nearest=5)
    assert len(split.sources) == 24
    for row, vertex in enumerate(split.sources):
        found, place = flat[split[row][0]], faces.ravel()[vertex]
        assert {tuple(at) for at in found} == {tuple(at) for at in places[own[place][0]]}
        assert np.allclose(split[row][1], own[place][1])
    others = geodisk.neighbours(flat, np.arange(24).reshape(8, 3), among="sources", nearest=2)
    assert others.sources.tolist() == [0, 1, 2, 4, 7, 14]
    assert (others.distances > 1).all()


def test_files_have_seams_as_well(tmp_path):
    path = tmp_path / "split.obj"
    path.write_text(
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n"
    )
    near = geodisk.neighbours(path, within=0.1)
    assert near.sources.tolist() == [0, 1, 2, 3, 4, 5]
    assert near[3][0].tolist() == [0, 3]


def test_what_the_last_call_of_a_callback_raises_is_not_lost():
    last = _structs.Progress(decided=3, candidates=3)

    def search(hear):
        hear(None, ctypes.pointer(last))
        return "found"  # Nothing was left to stop.

    assert listened(lambda *_: None, search) == "found"
    with pytest.raises(ZeroDivisionError):
        listened(lambda *_: 1 / 0, search)


def test_what_handing_over_a_result_raises_is_not_lost(monkeypatch):
    def string_at(*_):
        raise MemoryError

    monkeypatch.setattr(ctypes, "string_at", string_at)
    with pytest.raises(MemoryError):
        _library.run("frame_style", text="y")


def test_progress_and_cancelling():
    heard = []
    geodisk.neighbours(KNOT, within=0.5, progress=lambda part, pairs: heard.append((part, pairs)))
    assert heard and all(0 <= part <= 1 for part, _ in heard)
    with pytest.raises(geodisk.Cancelled, match="returned False"):
        geodisk.neighbours(KNOT, within=0.5, progress=lambda *_: False)

    def fail(*_):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        geodisk.neighbours(KNOT, within=0.5, progress=fail)


def test_what_cannot_be_asked():
    def refuses(match, error=geodisk.InvalidArgument, **arguments):
        with pytest.raises(error, match=match):
            geodisk.neighbours(VERTICES, FACES, **{"within": 1, **arguments})

    refuses("not positive", within=0)
    refuses("not positive", within=float("inf"))
    refuses("within", error=(TypeError, geodisk.InvalidArgument), within="x")
    refuses("give within", within=None)
    refuses("give the sources", within=[1, 2])
    refuses("there are 2 sources", within=[1], sources=[0, 1])
    refuses("which no face uses", sources=[9999])
    refuses("sources have the shape", sources=[])
    refuses("sources", error=(TypeError, geodisk.InvalidArgument), sources=[0.5])
    refuses("none of vertices", among="faces")
    refuses("source 0 is in face 9999", sources=([9999], [[1, 0, 0]]))
    refuses("nearest", error=(TypeError, geodisk.InvalidArgument), nearest=-1)
    refuses("max_pairs is 0, not from 1", max_pairs=0)
    refuses("pairs are to be expected", error=geodisk.Error, max_pairs=1)
