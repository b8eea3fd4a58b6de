"""Attributes of meshes at samples."""

import numpy as np
import pytest

import geodisk

SQUARE = [[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
OBJ = (
    "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\n"
    "vt 0 0\nvt 2 0\nvt 2 2\nvt 0 2\nf 1/1 2/2 3/3 4/4\n"
)


@pytest.fixture
def obj(tmp_path):
    path = tmp_path / "square.obj"
    path.write_text(OBJ)
    return path


def test_values_of_vertices_corners_and_faces():
    mesh = geodisk.Mesh(SQUARE, [[0, 1, 2, 3]])
    samples = geodisk.sample(mesh, min_distance=0.1)
    assert np.allclose(samples.interpolate(SQUARE), samples.points, atol=1e-6)
    x = np.array(SQUARE)[:, 0]
    of_corners = x[mesh.triangles]
    assert np.allclose(samples.interpolate(of_corners, of="corners"), samples.points[:, 0], atol=1e-6)
    assert set(samples.interpolate([5, 7], of="faces")) == {5, 7}  # Of triangles.
    assert set(samples.interpolate(["wood"], of="faces")) == {"wood"}  # Of the polygon.
    labels = samples.interpolate([0, 1, 2, 3])
    assert labels.dtype.kind == "i"
    nearest = np.take_along_axis(
        mesh.triangles[samples.face_index], samples.barycentric.argmax(1)[:, None], 1
    )[:, 0]
    assert np.array_equal(labels, nearest)
    assert samples[:5].interpolate(SQUARE).shape == (5, 3)


def test_values_that_do_not_fit():
    mesh = geodisk.Mesh(SQUARE, [[0, 1, 2, 3]])
    samples = geodisk.sample(mesh, min_distance=0.1)
    for values, of, text in [
        ([1, 2, 3], "vertices", r"shape \(3,\), but the mesh has 4 vertices"),
        ([1, 2, 3], "faces", "has 1 faces"),
        ([[1, 2]] * 2, "corners", "corners have the shape"),
        ([1.0, 2, np.nan, 3], "vertices", "not finite"),
        ([1, 2, 3, 4], "edges", "of is 'edges'"),
    ]:
        with pytest.raises(geodisk.InvalidArgument, match=text):
            samples.interpolate(values, of=of)
    with pytest.raises(TypeError):
        samples.interpolate([{}, {}, {}, {}])
    with pytest.raises(TypeError, match="text"):
        samples.interpolate(list("abcd"), nearest=False)
    with pytest.raises(geodisk.InvalidArgument, match="box"):
        geodisk.sample_box([1, 1], min_distance=0.2).interpolate([1])


def test_attributes_of_files(obj, tmp_path):
    mesh = geodisk.Mesh(obj, attributes="all")
    assert mesh.attributes["color"].shape == (2, 3, 3)
    samples = geodisk.sample(mesh, min_distance=0.2)
    assert np.allclose(samples.attributes["uv"], 2 * samples.points[:, :2], atol=1e-6)
    assert samples.attributes["color"].shape == (len(samples), 3)
    assert samples[3].attributes["uv"].shape == (2,)
    alone = geodisk.sample(obj, min_distance=0.2, attributes=["uv"])
    assert list(alone.attributes) == ["uv"]
    (many,) = geodisk.sample_many([obj], min_distance=0.2, attributes=["uv"])
    assert np.array_equal(many.attributes["uv"], alone.attributes["uv"])
    for ending in ("npz", "csv", "ply"):
        path = tmp_path / f"a.{ending}"
        samples.save(path)
        again = geodisk.read(path)
        assert list(again.attributes) == ["color", "uv"]
        for name, array in samples.attributes.items():
            assert np.allclose(again.attributes[name], array)
        values = again.interpolate(SQUARE, mesh=mesh)
        assert np.allclose(values, samples.points, atol=1e-6)
    with pytest.raises(geodisk.InvalidArgument, match="give mesh="):
        again.interpolate(SQUARE)
    with pytest.raises(geodisk.MeshRejected, match="no attribute 'heat'; it has color and uv"):
        geodisk.Mesh(obj, attributes=["heat"])
    with pytest.raises(TypeError, match="attributes"):
        geodisk.sample(mesh, min_distance=0.2, attributes=["uv"])


def test_dataframe_has_attributes(obj):
    pytest.importorskip("pandas")
    table = geodisk.sample(obj, min_distance=0.2, attributes="all").to_dataframe()
    assert {"red", "green", "blue", "u", "v"} <= set(table.columns)


def test_seams_keep_their_sides(tmp_path):
    path = tmp_path / "seam.ply"  # Two triangles that share an edge by place alone.
    path.write_text(
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
        "property float z\nproperty float side\nelement face 2\n"
        "property list uchar int vertex_indices\nend_header\n"
        "0 0 0 0\n1 0 0 0\n1 1 0 0\n0 0 0 1\n1 1 0 1\n0 1 0 1\n3 0 1 2\n3 3 4 5\n"
    )
    samples = geodisk.sample(path, min_distance=0.1, attributes=["side"])
    side = samples.attributes["side"]
    assert set(side) == {0, 1} and np.array_equal(side, samples.face_index)
    assert np.array_equal(samples.interpolate([0.0, 0, 0, 1, 1, 1]), side)


def test_normals_frames_and_textures_of_a_file(obj, tmp_path):
    samples = geodisk.sample(obj, min_distance=0.1, seed=3)
    found = geodisk.transfer(samples, obj, frames=True, normals="smooth", attributes=["uv", "color"])
    assert np.allclose(found.attributes["uv"], 2 * found.points[:, :2], atol=1e-6)
    assert found.attributes["color"].shape == (len(samples), 3)
    frames = found.attributes["frames"]
    assert frames.shape == (len(samples), 4)
    assert np.allclose(np.linalg.norm(frames, axis=1), 1, atol=1e-6)
    x, y, z, w = frames.T
    assert np.allclose(1 - 2 * (x * x + y * y), found.normals[:, 2], atol=1e-5)  # The turned z.
    assert np.array_equal(found[:5].attributes["frames"], frames[:5])
    arrays = geodisk.sample(SQUARE, [[0, 1, 2, 3]], min_distance=0.1)
    assert "frames" in geodisk.transfer(arrays, SQUARE, frames=True).attributes
    with pytest.raises(TypeError, match="need its path"):
        geodisk.transfer(arrays, SQUARE, attributes="all")
    with pytest.raises(geodisk.InvalidArgument, match="none.png"):
        geodisk.transfer(samples, obj, texture=tmp_path / "none.png")
    with pytest.raises(geodisk.InvalidArgument, match="normals"):
        geodisk.transfer(samples, obj, normals="round")
    with pytest.raises(TypeError, match="frames is 'no'"):
        geodisk.transfer(samples, obj, frames="no")
