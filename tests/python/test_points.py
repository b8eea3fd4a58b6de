"""Points as arrays, wherever points are taken, and samples as arrays."""

import numpy as np
import pytest

import geodisk
from meshes import FACES, VERTICES

MESH = geodisk.Mesh(VERTICES, FACES)
SAMPLES = geodisk.sample(MESH, min_distance=0.3, seed=2)
PLACES = (SAMPLES.face_index, SAMPLES.barycentric)


def test_samples_are_an_array_of_points():
    assert np.array_equal(np.asarray(SAMPLES), SAMPLES.points)
    assert np.asarray(SAMPLES, np.float32).dtype == np.float32
    copied = np.array(SAMPLES)
    copied[:] = 0
    assert SAMPLES.points.any()


@pytest.mark.parametrize("points", [SAMPLES.points, SAMPLES.points.tolist()])
def test_coordinates_are_points_of_the_mesh(points):
    kept = geodisk.sample(MESH, min_distance=0.3, seed=3, existing=points)
    assert kept.report["existing"] == len(SAMPLES)
    assert np.allclose(kept.points[: len(SAMPLES)], SAMPLES.points, atol=1e-5)
    avoiding = geodisk.sample(MESH, min_distance=0.2, avoid=(points[:3], 0.5))
    near = np.linalg.norm(avoiding.points[:, None] - SAMPLES.points[:3], axis=2)
    assert len(avoiding) > 0 and near.min() > 0.25  # Straight lines are shorter.
    assert len(geodisk.sample(MESH, min_distance=0.2)) > len(avoiding)
    assert np.allclose(geodisk.cells(MESH, points).area, geodisk.cells(MESH, SAMPLES).area, atol=1e-4)
    near = geodisk.neighbours(MESH, sources=points, within=0.4, among=points)
    assert np.array_equal(
        near.indices, geodisk.neighbours(MESH, sources=SAMPLES, within=0.4, among=SAMPLES).indices
    )


def test_two_rows_are_two_points_and_a_tuple_is_faces_and_weights():
    two = SAMPLES.points[:2].tolist()
    assert geodisk.sample(MESH, min_distance=0.3, existing=two).report["existing"] == 2
    pair = [PLACES[0][:2].tolist(), PLACES[1][:2].tolist()]
    for given in (pair, tuple(pair)):
        assert geodisk.sample(MESH, min_distance=0.3, existing=given).report["existing"] == 2


def test_a_mask_of_vertices_is_sources():
    mask = VERTICES[:, 2] > 0.2
    near = geodisk.neighbours(MESH, sources=mask, within=0.4)
    assert np.array_equal(near.sources, np.flatnonzero(mask))
    with pytest.raises(geodisk.InvalidArgument, match="a mask of the shape"):
        geodisk.neighbours(MESH, sources=mask[:-1], within=0.4)


def test_points_off_the_mesh_are_refused():
    with pytest.raises(geodisk.InvalidArgument, match="existing: .*off the mesh"):
        geodisk.sample(MESH, min_distance=0.3, existing=[[9.0, 9, 9]])
    with pytest.raises((TypeError, geodisk.InvalidArgument)):
        geodisk.sample(MESH, min_distance=0.3, existing=[[1.0, 2], [3]])


def test_no_seed_is_a_random_one():
    a, b = (geodisk.sample(MESH, min_distance=0.3, seed=None) for _ in range(2))
    assert a.seed != b.seed
    again = geodisk.sample(MESH, min_distance=0.3, seed=a.seed)
    assert np.array_equal(again.points, a.points)
    one, two = geodisk.sample_many([MESH, MESH], min_distance=0.3, seed=None)
    assert one.seed != two.seed
    assert geodisk.sample_box([1, 1], min_distance=0.2, seed=None).seed is not None


def test_a_number_in_place_of_faces_is_told_what_to_write():
    with pytest.raises(TypeError, match="give count=1000"):
        geodisk.sample(MESH, 1000)


@pytest.mark.parametrize("suffix", ["pcd", "obj", "xyz", "glb", "gltf", "usda", "vtp", "star"])
def test_samples_are_saved_as_the_program_writes_them(suffix, tmp_path):
    path = tmp_path / f"a.{suffix}"
    path.write_bytes(b"before")
    SAMPLES.save(path)
    assert path.read_bytes()[:4] != b"befo" and path.stat().st_size > 20 * len(SAMPLES)
    if suffix in ("xyz", "obj"):
        rows = [row.split() for row in path.read_text().splitlines() if row[:1] not in "#"]
        points = [row[-3:] for row in rows if suffix == "xyz" or row[0] == "v"]
        assert np.allclose(np.array(points, float), SAMPLES.points, atol=1e-6)
    geodisk.sample_box([1, 1, 1], min_distance=0.3).save(path)


def test_what_a_format_cannot_hold_is_refused_and_what_was_there_kept(tmp_path):
    coloured = SAMPLES[:]
    coloured.attributes["color"] = np.full((len(coloured), 3), 0.5)
    coloured.save(tmp_path / "a.glb")
    assert b"COLOR_0" in (tmp_path / "a.glb").read_bytes()
    path = tmp_path / "a.xyz"
    path.write_bytes(b"before")
    with pytest.raises(geodisk.InvalidArgument, match="^an .xyz file holds points alone"):
        coloured.save(path)
    assert path.read_bytes() == b"before"
    with pytest.raises(geodisk.InvalidArgument, match=r"saved as one of \*\.npz"):
        SAMPLES.save(tmp_path / "a.zip")
    assert sorted(one.name for one in tmp_path.iterdir()) == ["a.glb", "a.xyz"]
