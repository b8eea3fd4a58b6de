"""Samples as a sequence, a table and a pickle."""

import copy
import dataclasses
import multiprocessing
import os
import pickle
import subprocess

import numpy as np
import pytest

import geodisk
from geodisk._writing import digest_of
from meshes import FACES, VERTICES
from test_mesh_sources import CUBE, SIDES

SAMPLES = geodisk.sample(CUBE, SIDES, min_distance=0.2, seed=4)
COLUMNS = ["points", "normals", "face_index", "barycentric", "polygon_index", "radius", "order"]


@pytest.mark.parametrize(
    "key",
    [
        slice(5, 40, 3),
        slice(None, None, -1),
        [4, 2, 9],
        np.array([0, -1]),
        SAMPLES.points[:, 0] < 0.5,
        [],
        slice(0, 0),
    ],
)
def test_choosing(key):
    chosen = SAMPLES[key]
    rows = np.arange(len(SAMPLES))[key if len(np.atleast_1d(key)) else slice(0, 0)]
    assert isinstance(chosen, geodisk.Samples) and len(chosen) == len(rows)
    for name in COLUMNS:
        assert np.array_equal(getattr(chosen, name), getattr(SAMPLES, name)[rows]), name
    assert (chosen.min_distance, chosen.seed) == (0.2, 4)
    assert chosen.order.tolist() == rows.tolist()


def test_one_after_the_other():
    assert len(list(SAMPLES)) == len(SAMPLES)
    last = SAMPLES[-1]
    assert isinstance(last, geodisk.Sample) and last.order == len(SAMPLES) - 1
    assert last.radius == 0.1 and last.polygon_index == last.face_index // 2
    assert np.array_equal(last.point, SAMPLES.points[-1])
    box = next(iter(geodisk.sample_box([1, 1], min_distance=0.2)))
    assert box.face_index is None and box.point.shape == (2,)
    for bad in (len(SAMPLES), -len(SAMPLES) - 1, "radius", 1.5, np.zeros((2, 2), int), [0, 10**6]):
        with pytest.raises(IndexError):
            SAMPLES[bad]
    with pytest.raises(IndexError):
        SAMPLES[np.ones(3, bool)]


def test_pickles_hold_the_samples_alone():
    vertices = np.repeat(VERTICES, 20, axis=0)
    large = geodisk.sample(vertices, FACES * 20, min_distance=0.5)
    data = pickle.dumps(large)
    assert len(data) < 200 * len(large) + 2000 < vertices.nbytes
    again = pickle.loads(data)
    assert np.array_equal(again.points, large.points) and again.report == large.report
    assert again.min_distance == 0.5 and again.radius.dtype == np.float64
    with pytest.raises(ValueError, match="do not know their mesh"):
        geodisk.verify(again)
    for copied in (copy.copy(large), copy.deepcopy(large)):
        assert np.array_equal(copied.points, large.points) and copied._surface is large._surface
    assert copy.deepcopy(large).points is not large.points


def _shifted(samples):
    return samples.points[:, 0] + 1


def test_other_processes_take_samples_and_meshes():
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        (shifted,) = pool.map(_shifted, [SAMPLES[:9]])
    assert np.array_equal(shifted, SAMPLES.points[:9, 0] + 1)


def test_tables(monkeypatch):
    class DataFrame(dict):
        """As much of pandas as is used."""

        def __init__(self, columns):
            super().__init__(columns)
            self.attrs = {}

    import sys
    import types

    monkeypatch.setitem(sys.modules, "pandas", types.SimpleNamespace(DataFrame=DataFrame))
    table = SAMPLES.to_dataframe()
    assert list(table) == [
        *("x", "y", "z", "nx", "ny", "nz", "face_index", "bary_u", "bary_v", "bary_w"),
        *("polygon_index", "radius", "order"),
    ]
    assert np.array_equal(table["y"], SAMPLES.points[:, 1]) and table.attrs["seed"] == "4"
    assert list(geodisk.sample_box([1], min_distance=0.1).to_dataframe()) == ["x", "radius", "order"]
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match="pip install pandas"):
        SAMPLES.to_dataframe()


@pytest.mark.parametrize("kind", ["npz", "csv", "ply"])
def test_faces_as_given_are_saved(tmp_path, kind):
    SAMPLES.save(tmp_path / f"a.{kind}")
    again = geodisk.read(tmp_path / f"a.{kind}")
    assert again.polygon_index.dtype == np.uint32
    assert np.array_equal(again.polygon_index, SAMPLES.polygon_index)


@pytest.mark.parametrize("kind", ["npz", "csv", "ply"])
def test_files_of_some_samples_say_so(tmp_path, kind):
    whole = geodisk.sample(VERTICES, FACES, min_distance=0.3, seed=5)
    surface = {"vertices": VERTICES, "faces": FACES}
    path = tmp_path / f"a.{kind}"
    some = whole[whole.points[:, 0] > 0][:-3]
    some.save(path)
    read = geodisk.read(path)
    assert read.report["options"] == ["selection"]
    for one in (some, read, read[::-1], pickle.loads(pickle.dumps(some))):
        with pytest.raises(geodisk.InvalidArgument, match="removed, added or changed; give all"):
            geodisk.update(one, **surface)
    assert geodisk.verify(read, VERTICES, FACES)
    assert read._digest == digest_of(read.face_index, read.barycentric)
    columns = {name: getattr(whole, name)[:9] for name in COLUMNS if name != "polygon_index"}
    few = dataclasses.replace(geodisk.sample(VERTICES, FACES, min_distance=0.3, seed=5), **columns)
    few.save(path)
    assert geodisk.read(path).report["options"] == ["selection"]
    many = geodisk.sample_many([(VERTICES, FACES)] * 2, min_distance=0.5)
    many[0].save(path)
    assert "options" not in geodisk.read(path).report
    whole[::-1].save(path)  # All of them, in another order.
    assert "options" not in geodisk.read(path).report
    assert len(geodisk.update(geodisk.read(path), **surface)) == len(whole)


def test_the_program_knows_files_of_some_samples(tmp_path):
    mesh, path = tmp_path / "mesh.off", tmp_path / "some.csv"
    rows = [" ".join(map(repr, row)) for row in VERTICES.tolist()]
    rows += [f"3 {a} {b} {c}" for a, b, c in FACES.tolist()]
    mesh.write_text("\n".join([f"OFF\n{len(VERTICES)} {len(FACES)} 0", *rows, ""]))
    whole = geodisk.sample(mesh, min_distance=0.3)

    def told(*arguments):
        ended = subprocess.run(
            [os.environ["GEODISK_COMMAND"], *map(str, arguments)], capture_output=True, text=True
        )
        return ended.returncode, ended.stderr

    whole[whole.points[:, 0] > 0].save(path)
    status, text = told("verify", mesh, path)
    assert status == 0 and "digest" not in text and "removed" not in text
    update = ["sample", mesh, "-d", 0.3, "--from", mesh, "-o", tmp_path / "b.csv", "--update", path]
    status, text = told(*update)
    assert status != 0 and "selection" in text
    whole.save(path)
    assert told(*update)[0] == 0
