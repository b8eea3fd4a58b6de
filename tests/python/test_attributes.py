"""Attributes of meshes at samples."""

import base64
import json
import os
import pickle
import struct
import subprocess
import zlib
from pathlib import Path

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
            is_bytes = (ending, name) == ("ply", "color")
            assert np.allclose(again.attributes[name], array, atol=0.002 if is_bytes else 1e-8)
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
    with pytest.raises(TypeError, match="from files"):
        geodisk.transfer(arrays, SQUARE, attributes="all")


ROOF = (  # Two faces with normals of their own, and no other attribute of the roof.
    "v 0 0 0\nv 1 0 1\nv 1 1 1\nv 0 1 0\nv 2 0 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "vn 0 0 1\nvn 1 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\nf 2/1/2 5/2/2 6/3/2 3/4/2\n"
)


def write_png(path, rgb):
    """Writes an image of shape (h, w, 3)."""

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    height, width, _ = rgb.shape
    rows = b"".join(b"\0" + row.tobytes() for row in rgb.astype(np.uint8))
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
        + chunk(b"IDAT", zlib.compress(rows))
        + chunk(b"IEND", b"")
    )


@pytest.fixture
def roof(tmp_path):
    path = tmp_path / "roof.obj"
    path.write_text(ROOF)
    ramp = np.zeros((1, 4, 3))
    ramp[0, :, 0] = [0, 85, 170, 255]
    write_png(tmp_path / "ramp.png", ramp)
    return path


def test_sample_has_the_record_of_the_program(roof, tmp_path):
    texture = tmp_path / "ramp.png"
    record = dict(texture=texture, frames=True, attributes=["uv"])
    for normals in ("face", "file", "smooth"):
        samples = geodisk.sample(roof, min_distance=0.2, seed=5, normals=normals, **record)
        out = tmp_path / f"{normals}.npz"
        program = [os.environ.get("GEODISK_COMMAND", "geodisk"), "sample", str(roof), "-q", "-d", "0.2"]
        subprocess.run(
            [*program, "--seed", "5", "-o", str(out), "--normals", normals, "--frames"]
            + ["--texture", str(texture), "--attributes", "uv"],
            check=True,
        )
        told = np.load(out)
        assert np.array_equal(samples.face_index, told["face_index"])
        assert np.allclose(samples.normals, told["normals"], atol=1e-7)
        for name in ("color", "uv", "frames"):
            assert np.array_equal(samples.attributes[name], told[name]), name
    u = samples.attributes["uv"][:, 0]
    middle = (u > 0.125) & (u < 0.875)  # Between the centres of the outer pixels.
    expected = (u - 0.125) * 4 / 3
    assert np.allclose(samples.attributes["color"][middle, 0], expected[middle], atol=1e-4)
    by_face = geodisk.sample(roof, min_distance=0.2, seed=5, normals="file")
    tilted = by_face.polygon_index == 1
    assert np.allclose(by_face.normals[~tilted], [0, 0, 1])
    assert np.allclose(by_face.normals[tilted], np.array([1, 0, 1]) / np.sqrt(2))


def test_colours_of_materials(roof, tmp_path):
    plain, image = "newmtl plain\nKd 0.25 0.5 0.75\n", "newmtl paint\nmap_Kd ramp.png\n"
    (tmp_path / "roof.mtl").write_text(plain + image)
    lines = ROOF.split("f ")
    roof.write_text(
        f"mtllib roof.mtl\n{lines[0]}usemtl paint\nf {lines[1]}usemtl plain\nf {lines[2]}"
    )
    samples = geodisk.sample(roof, min_distance=0.2, seed=5, texture="auto")
    by_image = geodisk.sample(roof, min_distance=0.2, seed=5, texture=tmp_path / "ramp.png")
    first = samples.polygon_index == 0
    assert first.any() and not first.all()
    colours = samples.attributes["color"]
    assert np.array_equal(colours[first], by_image.attributes["color"][first])
    assert (colours[~first] == [0.25, 0.5, 0.75]).all()
    (many,) = geodisk.sample_many([roof], min_distance=0.2, seed=5, texture="auto")
    bare = geodisk.sample(roof, min_distance=0.2, seed=5)
    moved = geodisk.transfer(bare, roof, texture="auto")
    updated = geodisk.update(samples, roof)
    for other in (many, moved, updated):
        assert np.array_equal(other.attributes["color"], colours)

    with pytest.raises(TypeError, match="path of the mesh"):
        geodisk.sample(SQUARE, [[0, 1, 2, 3]], min_distance=0.2, texture="auto")
    with pytest.raises(geodisk.InvalidArgument, match="no such file"):
        geodisk.sample(roof, min_distance=0.2, texture=Path("auto"))  # An image.
    with pytest.raises(geodisk.MeshRejected, match="has no materials"):
        geodisk.sample("builtin:cube", min_distance=0.2, texture="auto")
    (tmp_path / "ramp.png").write_bytes(b"text")
    with pytest.raises(geodisk.InvalidArgument, match="material 'paint'.*is no PNG, JPEG, WebP, TGA or BMP"):
        geodisk.sample(roof, min_distance=0.2, texture="auto")
    (tmp_path / "ramp.png").unlink()
    with pytest.raises(geodisk.MeshRejected, match="material 'paint'.*ramp.png is not there"):
        geodisk.sample(roof, min_distance=0.2, texture="auto")


def test_files_outside_of_the_folder_of_a_mesh_are_read_where_allowed(tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "m.mtl").write_text("newmtl a\nKd 1 0.5 0\n")
    mesh = tmp_path / "in" / "m.obj"
    mesh.write_text("mtllib ../m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n")
    given = dict(min_distance=0.3, texture="auto")
    with pytest.raises(geodisk.MeshRejected, match=r"'\.\./m\.mtl' is not a file of its folder.*add allow_outside"):
        geodisk.sample(mesh, **given)
    samples = geodisk.sample(mesh, allow_outside=True, **given)
    (many,) = geodisk.sample_many([mesh], allow_outside=True, **given)
    bare = geodisk.sample(mesh, min_distance=0.3)
    moved = geodisk.transfer(bare, mesh, texture="auto", allow_outside=True)
    updated = geodisk.update(samples, mesh, allow_outside=True)
    for other in (samples, many, moved, updated):
        assert (other.attributes["color"] == [1, 0.5, 0]).all()


def test_sample_transfer_and_many_have_one_record(roof, tmp_path):
    record = dict(texture=tmp_path / "ramp.png", normals="smooth", frames=True, attributes="all")
    samples = geodisk.sample(roof, min_distance=0.2, seed=5, **record)
    (many,) = geodisk.sample_many([roof], min_distance=0.2, seed=5, **record)
    plain = geodisk.sample(roof, min_distance=0.2, seed=5)
    moved = geodisk.transfer(plain, roof, **record)
    for other in (many, moved):
        assert np.array_equal(other.normals, samples.normals)
        assert list(other.attributes) == list(samples.attributes) == ["uv", "color", "frames"]
        for name, array in samples.attributes.items():
            assert np.array_equal(other.attributes[name], array), name
    ordered = geodisk.sample(roof, min_distance=0.2, seed=5, order="farthest", frames=True)
    turned = {f.tobytes() for f in samples.attributes["frames"]}
    assert len(turned) == len(samples) and len(ordered) == len(samples)
    few = samples[3:9]
    for name in ("color", "frames"):
        assert np.array_equal(few.attributes[name], samples.attributes[name][3:9])
    assert np.array_equal(few.normals, samples.normals[3:9])
    assert np.array_equal(few[0].attributes["frames"], samples.attributes["frames"][3])


def turned(frames, v):
    """Returns a vector as each of the frames turns it."""
    axis, w = frames[:, :3], frames[:, 3:]
    return v + 2 * w * np.cross(axis, v) + 2 * np.cross(axis, np.cross(axis, v))


def test_frames_are_upright_or_a_part_of_the_way_to_the_normal(roof):
    def frames(style, **given):
        samples = geodisk.sample(roof, min_distance=0.2, seed=5, frames=style, **given)
        return samples, samples.attributes["frames"]

    samples, upright = frames("upright")
    assert np.allclose(upright[:, :2], 0)  # Turns about z alone.
    assert len(np.unique(upright[:, 2])) == len(samples)
    assert np.array_equal(frames("1")[1], frames(True)[1])
    y, z = np.eye(3)[1:]
    assert np.allclose(turned(frames("y")[1], y), samples.normals, atol=1e-6)
    assert np.allclose(turned(frames("y,upright")[1], y), z)
    assert np.allclose(turned(frames("upright", up="y")[1], z), y)
    half = turned(frames("0.5")[1], z)  # The roof has slopes of 45 degrees.
    assert np.allclose(half[:, 2], np.cos(np.pi / 8), atol=1e-6)
    assert np.allclose(half[:, 0], np.sin(np.pi / 8) * np.sign(samples.normals[:, 0]), atol=1e-6)


def test_frames_keep_their_style(roof, tmp_path):
    style = dict(frames="y,0.25", up="x")
    samples = geodisk.sample(roof, min_distance=0.2, seed=5, **style)
    (many,) = geodisk.sample_many([roof], min_distance=0.2, seed=5, **style)
    others = [many, geodisk.transfer(samples, roof), geodisk.update(samples, roof)]
    for kind in ("npz", "csv", "ply"):
        samples.save(tmp_path / f"a.{kind}")
        others.append(geodisk.transfer(geodisk.read(tmp_path / f"a.{kind}"), roof, roof))
    expected = samples.attributes["frames"]
    for other in others:
        assert np.allclose(other.attributes["frames"], expected, atol=1e-6)
    there = geodisk.transfer(samples, roof, up="z")
    assert not np.allclose(there.attributes["frames"], expected, atol=0.01)
    program = [os.environ.get("GEODISK_COMMAND", "geodisk"), "sample", str(roof), "-q", "-d", "0.2"]
    out = tmp_path / "b.csv"
    subprocess.run([*program, "--seed", "5", "--frames=y,0.25", "--up", "x", "-o", out], check=True)
    assert np.allclose(geodisk.read(out).attributes["frames"], expected, atol=1e-6)
    assert "# frames: y,0.25\n# frames_up: x\n" in (tmp_path / "a.csv").read_text()
    assert "# frames: y,0.25\n# frames_up: x\n" in out.read_text()


def test_frames_keep_to_y_on_a_mesh_of_gltf(tmp_path):
    trimesh = pytest.importorskip("trimesh")
    trimesh.creation.icosphere(1).export(tmp_path / "a.glb")
    mesh = geodisk.Mesh(tmp_path / "a.glb")
    for one in (mesh, pickle.loads(pickle.dumps(mesh)), tmp_path / "a.glb"):
        samples = geodisk.sample(one, min_distance=0.3, frames="upright")
        assert np.allclose(turned(samples.attributes["frames"], np.eye(3)[2]), np.eye(3)[1])
    samples.save(tmp_path / "b.usda")
    assert 'upAxis = "Y"' in (tmp_path / "b.usda").read_text()
    geodisk.sample(mesh, min_distance=0.3, frames="upright", up="z").save(tmp_path / "b.usda")
    assert 'upAxis = "Z"' in (tmp_path / "b.usda").read_text()


def test_dataframe_has_the_record(roof, tmp_path):
    pytest.importorskip("pandas")
    samples = geodisk.sample(
        roof, min_distance=0.2, texture=tmp_path / "ramp.png", frames=True, normals="file"
    )
    table = samples[:7].to_dataframe()
    assert {"red", "green", "blue", "qx", "qy", "qz", "qw", "nx", "ny", "nz"} <= set(table.columns)
    assert np.array_equal(table["red"], samples.attributes["color"][:7, 0])
    assert np.array_equal(table["qw"], samples.attributes["frames"][:7, 3])


def test_meshes_of_arrays_have_smooth_normals_and_frames():
    bent = np.array([[0.0, 0, 0], [1, 0, 1], [1, 1, 1], [0, 1, 0], [2, 0, 0], [2, 1, 0]])
    faces = [[0, 1, 2, 3], [1, 4, 5, 2]]
    samples = geodisk.sample(bent, faces, min_distance=0.2, normals="smooth", frames=True)
    ridge = np.abs(samples.points[:, 0] - 1) < 0.05
    assert ridge.any() and (samples.normals[ridge, 2] > 0.99).all()
    assert np.allclose(np.linalg.norm(samples.normals, axis=1), 1)
    triangles = geodisk.Mesh(bent, faces)
    again = geodisk.sample(triangles, min_distance=0.2, normals="smooth", frames=True)
    apart = geodisk.sample(  # The same as two pieces, whose border edges are joined.
        bent[[0, 1, 2, 3, 1, 4, 5, 2]],
        [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]],
        min_distance=0.2,
        normals="smooth",
        frames=True,
    )
    for other in (again, apart, geodisk.sample(pickle.loads(pickle.dumps(triangles)),
                                               min_distance=0.2, normals="smooth", frames=True)):
        assert np.allclose(other.normals, samples.normals, atol=1e-7)
        assert np.allclose(other.attributes["frames"], samples.attributes["frames"], atol=1e-6)


def ply_columns(path):
    """Returns types and values of the columns of a binary PLY file, by name."""
    head, _, body = path.read_bytes().partition(b"end_header\n")
    kinds = {"uchar": "u1", "int": "<i4", "uint": "<u4", "float": "<f4", "double": "<f8"}
    lines = [line.split() for line in head.decode().splitlines()]
    types = [(line[2], kinds[line[1]]) for line in lines if line[0] == "property"]
    return np.frombuffer(body, np.dtype(types))


def test_ply_has_colours_as_the_program_writes_them(roof, tmp_path):
    how = {"min_distance": 0.2, "seed": 5, "texture": tmp_path / "ramp.png"}
    samples = geodisk.sample(roof, **how)
    samples.attributes["face_color"] = np.full((len(samples), 4), 0.5)
    samples.save(tmp_path / "own.ply")
    program = [os.environ.get("GEODISK_COMMAND", "geodisk"), "sample", str(roof), "-q", "-d", "0.2"]
    out = ["-o", str(tmp_path / "program.ply"), "--texture", str(tmp_path / "ramp.png")]
    subprocess.run([*program, "--seed", "5", *out], check=True)
    own, told = ply_columns(tmp_path / "own.ply"), ply_columns(tmp_path / "program.ply")
    expected = np.floor(255 * samples.attributes["color"] + 0.5)
    for column, name in enumerate(("red", "green", "blue")):
        assert own.dtype[name] == told.dtype[name] == np.uint8
        assert np.array_equal(own[name], expected[:, column])
        assert np.array_equal(own[name], told[name])
    assert own.dtype["face_alpha"] == np.uint8 and (own["face_red"] == 128).all()
    again = geodisk.read(tmp_path / "own.ply")
    assert np.array_equal(again.attributes["color"], expected / 255)
    assert again.attributes["face_color"].shape == (len(samples), 4)
    samples.attributes["color"] = np.full((len(samples), 3), np.nan)
    with pytest.raises(geodisk.InvalidArgument, match="not finite"):
        samples.save(tmp_path / "own.ply")


def test_colours_of_gltf_are_light(tmp_path):
    corners = np.array([[0, 0, 0, 0], [1, 0, 0, 1], [0, 1, 0, 0]], "<f4")
    light = np.stack([corners[:, 3], np.full(3, 0.5), np.full(3, 1.0), np.full(3, 0.5)], axis=1)
    data = corners[:, :3].tobytes() + light.astype("<f4").tobytes()
    accessor = {"componentType": 5126, "count": 3}
    text = json.dumps(
        {
            "asset": {"version": "2.0"},
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "COLOR_0": 1}}]}],
            "accessors": [
                {"bufferView": 0, "type": "VEC3", **accessor},
                {"bufferView": 1, "type": "VEC4", **accessor},
            ],
            "bufferViews": [
                {"buffer": 0, "byteLength": 36},
                {"buffer": 0, "byteOffset": 36, "byteLength": 48},
            ],
            "buffers": [
                {
                    "byteLength": len(data),
                    "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode(),
                }
            ],
        }
    )
    path = tmp_path / "a.gltf"
    path.write_text(text)
    mesh = geodisk.Mesh(path, attributes="all")
    assert np.allclose(mesh.attributes["color"].reshape(-1, 4)[0], [0, 0.735357, 1, 0.5], atol=1e-6)
    samples = geodisk.sample(mesh, min_distance=0.1)
    red = samples.attributes["color"][:, 0]
    shown = np.where(red <= 0.04045, red / 12.92, ((red + 0.055) / 1.055) ** 2.4)
    assert np.allclose(shown, samples.points[:, 0], atol=1e-6)  # Interpolated as light.
    assert np.allclose(samples.attributes["color"][:, 1:], [0.735357, 1, 0.5], atol=1e-6)


def test_records_that_cannot_be(obj, roof, tmp_path):
    samples = geodisk.sample(roof, min_distance=0.2)
    for call in (
        lambda **record: geodisk.sample(roof, min_distance=0.2, **record),
        lambda **record: geodisk.sample_many([roof], min_distance=0.2, **record),
        lambda **record: geodisk.transfer(samples, roof, **record),
    ):
        with pytest.raises(geodisk.InvalidArgument, match="none.png"):
            call(texture=tmp_path / "none.png")
        with pytest.raises(geodisk.InvalidArgument, match="normals is 'round'"):
            call(normals="round")
        with pytest.raises(TypeError, match="frames is .*, neither True, False, a number nor"):
            call(frames=[1])
        with pytest.raises(geodisk.InvalidArgument, match="nor a number from 0 to 1"):
            call(frames=2)
        with pytest.raises(geodisk.InvalidArgument, match="frames: 'no' is neither x, y or z"):
            call(frames="no")
        with pytest.raises(geodisk.InvalidArgument, match="up is for frames"):
            call(frames="y", up="y")
        with pytest.raises(geodisk.InvalidArgument, match="up is 'w'"):
            call(frames="upright", up="w")
    with pytest.raises(geodisk.MeshRejected, match="no normals"):
        geodisk.sample(obj, min_distance=0.2, normals="file")
    both = geodisk.sample(obj, min_distance=0.2, texture=tmp_path / "ramp.png", attributes="all")
    assert list(both.attributes) == ["vertex_color", "uv", "color"]
    assert list(geodisk.transfer(both, obj).attributes) == list(both.attributes)
    mesh = geodisk.Mesh(roof)
    for record in ({"texture": tmp_path / "ramp.png"}, {"normals": "file"}):
        with pytest.raises(TypeError, match="path of the mesh"):
            geodisk.sample(mesh, min_distance=0.2, **record)
        with pytest.raises(TypeError, match="path of the mesh"):
            geodisk.sample(SQUARE, [[0, 1, 2, 3]], min_distance=0.2, **record)
    flat = np.array(SQUARE)[:, :2]
    with pytest.raises(geodisk.InvalidArgument, match="3 coordinates"):
        geodisk.sample(flat, [[0, 1, 2, 3]], min_distance=0.2, frames=True)


def own_attributes(samples):
    n = len(samples)
    return {
        "label": np.arange(n) - 3,
        "flag": np.arange(n) % 2 == 0,
        "whole": np.ones(n),
        "half": np.arange(n) / 2,
        "far": np.where(np.arange(n) == 1, np.inf, 2.0),
        "pair": np.arange(2 * n).reshape(n, 2),
        "color": np.zeros((n, 3)),
    }


@pytest.mark.parametrize("kind", ["npz", "csv", "ply"])
def test_attributes_keep_their_types_in_files(tmp_path, kind):
    samples = geodisk.sample_box([1, 1], min_distance=0.2)
    samples.attributes.update(own_attributes(samples))
    samples.save(tmp_path / f"a.{kind}")
    again = geodisk.read(tmp_path / f"a.{kind}").attributes
    if kind != "npz":
        pair = [again.pop("pair_0"), again.pop("pair_1")]
        again["pair"] = np.stack(pair, axis=1)
    assert set(again) == set(samples.attributes)
    for name, values in own_attributes(samples).items():
        assert np.array_equal(again[name], values), name
        assert again[name].dtype == (np.float64 if values.dtype == float else np.int32), name


def test_text_of_ply_has_the_types_of_its_header(tmp_path):
    path = tmp_path / "a.ply"
    path.write_text(
        "ply\nformat ascii 1.0\ncomment box: 1.0 x 1.0\nelement vertex 2\n"
        "property double x\nproperty double y\nproperty int label\nproperty double level_of\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
        "end_header\n0 0 7 1 255 0 0\n1 1 8 2 0 255 51\n"
    )
    read = geodisk.read(path)
    assert read.attributes["label"].dtype == np.int32
    assert read.attributes["level_of"].dtype == np.float64
    assert np.allclose(read.attributes["color"], [[1, 0, 0], [0, 1, 0.2]])


@pytest.mark.parametrize("kind", ["npz", "csv", "ply"])
@pytest.mark.parametrize(
    "name, values, error, text",
    [
        ("a", [1.0, 2.0], ValueError, r"'a' has the shape \(2,\), not"),
        ("a", 3.0, ValueError, r"'a' has the shape \(\), not"),
        ("a", np.full(36, None), TypeError, "'a' has to be of numbers, not of object"),
        ("a", np.full(36, "b"), TypeError, "'a' has to be of numbers"),
        ("a", np.full(36, 1j), TypeError, "'a' has to be of numbers"),
        ("a", np.full(36, -(2**63)), ValueError, "'a' has integers above 2"),
        ("a", np.ma.masked_all(36), TypeError, "'a' has masked values"),
        ("a", [[1], [2, 3]] * 18, TypeError, "'a' has to be an array"),
        ("points", np.zeros(36), ValueError, "'points' has the name of a column"),
        ("x", np.zeros(36), ValueError, "'x' has the name of a column"),
        ("class", np.zeros(36), ValueError, "'class' has the name of a column"),
        ("", np.zeros(36), TypeError, "the name of an attribute is ''"),
        (3, np.zeros(36), TypeError, "the name of an attribute is 3"),
    ],
)
def test_attributes_that_do_not_fit_are_not_saved(tmp_path, kind, name, values, error, text):
    samples = geodisk.sample_box([1, 1], count=36, exact=True)
    samples.attributes[name] = values
    with pytest.raises(error, match=text):
        samples.save(tmp_path / f"a.{kind}")
    assert list(tmp_path.iterdir()) == []


def test_columns_that_do_not_fit_are_not_saved(tmp_path):
    samples = geodisk.sample_box([1, 1], count=36, exact=True)
    samples.attributes.update({"a b": np.zeros(36), "a_b": np.ones(36)})
    with pytest.raises(geodisk.InvalidArgument, match="two attributes have the column 'a_b'"):
        samples.save(tmp_path / "a.npz")
    del samples.attributes["a_b"]
    samples.save(tmp_path / "a.ply")
    assert list(geodisk.read(tmp_path / "a.ply").attributes) == ["a_b"]
    samples.columns["group"] = np.zeros(3, np.uint32)
    with pytest.raises(geodisk.InvalidArgument, match="group has the shape"):
        samples.save(tmp_path / "b.csv")
    with pytest.raises(geodisk.InvalidArgument, match="group has the shape"):
        samples[:2]
    samples.columns["group"] = np.zeros(36, np.uint32)
    samples.points[3, 0] = np.nan
    with pytest.raises(geodisk.InvalidArgument, match="points.* is nan"):
        samples.save(tmp_path / "b.csv")
    assert [path.name for path in tmp_path.iterdir()] == ["a.ply"]


def test_densities_of_faces_corners_and_names(tmp_path):
    path = tmp_path / "m.obj"
    path.write_text(
        "v 0 0 0 1 0 0\nv 1 0 0 0 0 0\nv 1 3 0 0 0 0\nv 0 1 0 1 0 0\nv 2 0 0 0 1 0\n"
        "f 1 2 3\nf 1 3 4\nf 2 5 3\n"
    )
    mesh = geodisk.Mesh(path, attributes="all")

    def places(density):
        return geodisk.sample(mesh, count=100, density=density).points.tolist()

    red = np.array([1.0, 0, 0, 1, 0])
    corners = red[[[0, 1, 2], [0, 2, 3], [1, 4, 2]]]
    assert places("red") == places(red) == places(corners)
    assert places("color") == places(red * 77 / 256 + np.array([0, 0, 0, 0, 1]) * 150 / 256)
    # Areas of 1.5, 0.5 and 1.5.
    mean = [(1.5 * 1 + 0.5 * 5) / 2, (1.5 + 3) / 3, (1.5 + 2.5 + 3) / 3.5, 5, 2]
    assert np.allclose(
        geodisk.sample(mesh, count=100, density=[1, 5, 2]).points,
        geodisk.sample(mesh, count=100, density=mean).points,
    )
    with pytest.raises(geodisk.InvalidArgument, match=r"one for each face, or \(3, 3\)"):
        places(np.ones(7))
    with pytest.raises(geodisk.InvalidArgument, match="read with the attributes color; give"):
        places("heat")


def test_a_density_by_the_name_of_an_attribute_is_read_with_the_file(tmp_path):
    path = tmp_path / "a.ply"
    path.write_text(
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nproperty float quality\nelement face 2\n"
        "property list uchar int vertex_indices\nend_header\n"
        "0 0 0 0\n1 0 0 0\n1 1 0 1\n0 1 0 1\n3 0 1 2\n3 0 2 3\n"
    )
    mesh = geodisk.Mesh(path, attributes="quality")
    expected = geodisk.sample(mesh, count=100, density="quality")
    for made in (
        geodisk.sample(path, count=100, density="quality"),
        geodisk.sample(str(path), count=100, density="quality", attributes=["quality"]),
        geodisk.sample_many([path], count=100, density=["quality"])[0],
    ):
        assert np.array_equal(made.points, expected.points)
    turned = geodisk.sample(path, count=100, frames=0.3)
    text = geodisk.sample(path, count=100, frames="0.3")
    assert np.array_equal(turned.attributes["frames"], text.attributes["frames"])
    with pytest.raises(geodisk.MeshRejected, match="has no attribute 'nope'; it has quality"):
        geodisk.sample(path, count=100, density="nope")
