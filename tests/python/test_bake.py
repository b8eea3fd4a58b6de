"""Maps of the nearest sample, against other means."""

import dataclasses
import os
import pickle
import struct
import subprocess
import zlib

import numpy as np
import pytest

import geodisk


def write_obj(path, points, uvs, faces):
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in np.asarray(points, float).tolist()]
    lines += [f"vt {u!r} {v!r}" for u, v in np.asarray(uvs, float).tolist()]
    lines += ["f " + " ".join(f"{i + 1}/{i + 1}" for i in face) for face in faces]
    path.write_text("\n".join(lines) + "\n")
    return path


def sheet(n):
    """A half pipe, developable, with texture coordinates along it: u by angle, v by height."""
    u, v = (x.ravel() for x in np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1)))
    points = np.stack([np.cos(np.pi * u), np.sin(np.pi * u), 2 * v], axis=1)
    faces = [
        [a, a + 1, a + n + 2, a + n + 1]
        for a in (y * (n + 1) + x for y in range(n) for x in range(n))
    ]
    return points, np.stack([u, v], axis=1), faces


def centres(width, height):
    """u and v of each texel."""
    u = (np.arange(width) + 0.5) / width
    v = 1 - (np.arange(height) + 0.5) / height
    return np.meshgrid(u, v)


@pytest.fixture
def pipe(tmp_path):
    return write_obj(tmp_path / "pipe.obj", *sheet(24))


def test_map_is_that_of_the_unrolled_sheet(pipe):
    samples = geodisk.sample(pipe, count=60, attributes=["uv"])
    found = geodisk.bake(pipe, samples, size=(96, 64))
    assert found.sample.shape == found.distance.shape == found.face.shape == (64, 96)
    assert (found.face >= 0).all() and found.overlapping == 0
    step = 24 * 2 * np.sin(np.pi / 48)  # The width of the sheet, of flat strips.
    u, v = centres(96, 64)
    at = samples.attributes["uv"]
    apart = np.hypot(
        step * (u[..., None] - at[:, 0]), 2 * (v[..., None] - at[:, 1])
    )  # Of each texel from each sample.
    assert np.abs(found.distance - apart.min(axis=2)).max() < 1e-5
    nearest = np.take_along_axis(apart, found.sample[..., None], axis=2)[..., 0]
    assert (nearest - apart.min(axis=2)).max() < 2e-5
    assert (found.sample != apart.argmin(axis=2)).mean() < 0.01


def test_distances_of_small_maps_are_exact(pipe):
    samples = geodisk.sample(pipe, count=60, attributes=["uv"])
    step = 24 * 2 * np.sin(np.pi / 48)
    at = samples.attributes["uv"]
    for size in [(1, 1), (3, 2), (7, 5)]:
        found = geodisk.bake(pipe, samples, size=size)
        u, v = centres(*size)
        apart = np.hypot(step * (u[..., None] - at[:, 0]), 2 * (v[..., None] - at[:, 1]))
        assert np.abs(found.distance - apart.min(axis=2)).max() < 1e-5


def test_areas_are_those_of_cells(pipe):
    mesh = geodisk.Mesh(pipe)
    samples = geodisk.sample(mesh, count=40, seed=3)
    found = geodisk.bake(pipe, samples, size=512)
    texels = np.bincount(found.sample.ravel(), minlength=len(samples))
    areas = geodisk.cells(mesh, samples, dual=False).area
    assert np.abs(texels / texels.sum() * mesh.area - areas).max() < 0.01 * areas.mean()


def test_map_agrees_with_neighbours(tmp_path):
    rng = np.random.default_rng(5)
    points, uvs, faces = sheet(8)
    points = points + 0.05 * rng.standard_normal(points.shape)
    path = write_obj(tmp_path / "bumpy.obj", points, uvs, faces)
    mesh = geodisk.Mesh(path)
    samples = geodisk.sample(mesh, count=25, seed=2)
    found = geodisk.bake(path, samples, size=40)
    corners = np.array(uvs)[mesh.triangles[found.face.ravel()]]
    u, v = (x.ravel() for x in centres(40, 40))
    sides = corners[:, 1:] - corners[:, :1]
    target = np.stack([u, v], axis=1) - corners[:, 0]
    b = np.linalg.solve(sides.transpose(0, 2, 1), target[..., None])[..., 0]
    weights = np.clip(np.column_stack([1 - b.sum(axis=1), b]), 0, 1)
    weights = (weights / weights.sum(axis=1, keepdims=True)).astype(np.float32)
    texels = (found.face.ravel(), weights)
    near = geodisk.neighbours(mesh, sources=texels, among=samples, nearest=1)
    assert np.abs(near.distances - found.distance.ravel()).max() < 1e-5
    assert (near.indices == found.sample.ravel()).mean() > 0.98


def test_parts_without_samples_and_texels_without_faces(tmp_path):
    points, uvs, faces = sheet(4)
    both = np.concatenate([points, points + [5, 0, 0]])
    # One sheet in the lower left quarter, one in the upper right quarter.
    charts = np.concatenate([0.5 * uvs, 0.5 * uvs + 0.5])
    path = write_obj(tmp_path / "two.obj", both, charts, faces + [[i + 25 for i in f] for f in faces])
    samples = geodisk.Samples(points[[0, 12]])
    found = geodisk.bake(path, samples, size=16)
    quarters = found.sample[8:, :8], found.sample[:8, 8:], found.sample[:8, :8]
    assert set(quarters[0].ravel()) == {0, 1} and set(quarters[1].ravel()) == {-1}
    assert (found.face[:8, 8:] >= 0).all() and np.isinf(found.distance[:8, 8:]).all()
    assert (quarters[2] == -1).all() and (found.face[:8, :8] == -1).all()
    assert np.isnan(found.distance[:8, :8]).all()


def test_meshes_of_files_are_baked(pipe, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    mesh = geodisk.Mesh("pipe.obj")
    samples = geodisk.sample(mesh, count=60)
    expected = geodisk.bake("pipe.obj", samples, size=32)
    monkeypatch.chdir("/")
    for one in (mesh, pickle.loads(pickle.dumps(mesh))):
        found = geodisk.bake(one, samples, size=32)
        assert np.array_equal(found.sample, expected.sample)
        assert np.array_equal(found.distance, expected.distance)
    pipe.write_text(pipe.read_text().replace("v 1.0 0.0 0.0", "v 1.5 0.0 0.0"))
    with pytest.raises(geodisk.InvalidArgument, match="changed since the mesh was read"):
        geodisk.bake(mesh, samples, size=32)
    pipe.unlink()
    with pytest.raises(FileNotFoundError):
        geodisk.bake(mesh, samples, size=32)


def test_walls_are_those_of_the_program(tmp_path):
    points, uvs, faces = sheet(6)
    halves = faces[::2], faces[1::2]
    path = write_obj(tmp_path / "a.obj", points, uvs, halves[0] + halves[1])
    text = path.read_text().replace("f ", "g wall\nf ", 1)
    second = "f " + " ".join(f"{i + 1}/{i + 1}" for i in halves[1][0])
    path.write_text(text.replace(second, f"g other\n{second}"))
    cuts = np.array([[3 + 7 * i, 10 + 7 * i] for i in range(5)])
    (tmp_path / "cuts.txt").write_text("".join(f"{a + 1} {b + 1}\n" for a, b in cuts))
    mask = np.arange(36) < 18
    program = [os.environ.get("GEODISK_COMMAND", "geodisk"), "bake", str(path)]
    program += [str(tmp_path / "s.csv"), "-q", "--size", "40", "--padding", "1"]
    for walls, told in ((cuts, f"edges:{tmp_path / 'cuts.txt'}"), (mask, "group:wall")):
        mesh = geodisk.Mesh(path, walls=walls)
        samples = geodisk.sample(mesh, min_distance=0.4)
        found = geodisk.bake(mesh, samples, size=40, padding=1)
        samples.save(tmp_path / "s.csv")
        more = ["--walls", told, "-o", str(tmp_path / "p.npz")]
        subprocess.run([*program, *more], check=True, capture_output=True)
        with np.load(tmp_path / "p.npz") as expected:
            assert np.array_equal(found.distance, expected["distance"], equal_nan=True)
            assert np.array_equal(found.sample, expected["sample"])
            assert np.array_equal(found.face, expected["face"])
    path.write_text(path.read_text().replace("v 1.0 ", "v 1.5 "))
    with pytest.raises(geodisk.InvalidArgument, match="changed since the mesh was read"):
        geodisk.bake(mesh, samples, size=32)


def quarter(path):
    """A sheet in the lower left quarter of its texture."""
    points, uvs, faces = sheet(4)
    return write_obj(path, points, 0.5 * uvs, faces)


@pytest.mark.parametrize("padding", [1, 3, 100])
def test_padding_has_the_values_of_the_nearest_texel(tmp_path, padding):
    path = quarter(tmp_path / "a.obj")
    samples = geodisk.sample(path, count=20)
    bare = geodisk.bake(path, samples, size=(24, 16))
    found = geodisk.bake(path, samples, size=(24, 16), padding=padding)
    assert np.array_equal(found.face, bare.face)
    rows, columns = np.nonzero(bare.face >= 0)
    for y in range(16):
        for x in range(24):
            square = (rows - y) ** 2 + (columns - x) ** 2
            near = square.argmin()
            if square[near] <= padding**2:
                assert found.sample[y, x] == bare.sample[rows[near], columns[near]]
                assert found.distance[y, x] == bare.distance[rows[near], columns[near]]
            else:
                assert found.sample[y, x] == -1 and np.isnan(found.distance[y, x])


def png_of_16_bits(path):
    """Returns the channels of a PNG file as the standard has it, from 0 to 65535."""
    data, at, idat = path.read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at : at + 8])
        content = data[at + 8 : at + 8 + size]
        assert zlib.crc32(kind + content) == int.from_bytes(data[at + 8 + size :][:4], "big")
        if kind == b"IHDR":
            width, height, bits, colour = struct.unpack(">IIBB", content[:10])
        idat += content if kind == b"IDAT" else b""
        at += size + 12
    channels = {0: 1, 4: 2}[colour]
    rows = np.frombuffer(zlib.decompress(idat), np.uint8).reshape(height, -1)
    assert bits == 16 and (rows[:, 0] == 1).all()
    pixels = rows[:, 1:].reshape(height, width, 2 * channels).cumsum(axis=1, dtype=np.uint8)
    return pixels.view(">u2")


def test_maps_are_saved_as_the_program_writes_them(tmp_path, pipe):
    path = quarter(tmp_path / "a.obj")
    samples = geodisk.sample(path, count=20)
    samples.save(tmp_path / "s.npz")
    samples.save(tmp_path / "s.ply")
    found = geodisk.bake(path, samples, size=64, padding=2)
    program = [os.environ.get("GEODISK_COMMAND", "geodisk"), "bake", str(path), str(tmp_path / "s.ply")]
    program += ["-q", "--size", "64", "--padding", "2", "--style", "distance", "-o"]
    for name, more in (("a.npz", []), ("a.npy", []), ("a.png", []), ("deep.png", ["--depth", "16"])):
        found.save(tmp_path / name, depth=16 if more else 8)
        subprocess.run([*program, str(tmp_path / f"p-{name}"), *more], check=True)
        assert (tmp_path / name).read_bytes() == (tmp_path / f"p-{name}").read_bytes(), name
    assert np.array_equal(np.load(tmp_path / "a.npy"), found.distance, equal_nan=True)
    grey, alpha = np.moveaxis(png_of_16_bits(tmp_path / "deep.png"), 2, 0)
    assert np.array_equal(alpha == 65535, ~np.isnan(found.distance)) and set(alpha.ravel()) == {0, 65535}
    filled = np.nan_to_num(found.distance)
    assert np.abs(grey / 65535 - filled / filled.max()).max() <= 0.51 / 65535
    whole = geodisk.bake(pipe, geodisk.sample(pipe, count=9), size=16)
    whole.save(tmp_path / "whole.png", depth=16)
    assert png_of_16_bits(tmp_path / "whole.png").shape == (16, 16, 1)
    for name, depth, message in (
        ("a.exr", 8, "written as .npz, .npy or .png; for distances as floats, write .npy"),
        ("a.png", 12, "'12' is neither 8 nor 16"),
        ("a.npy", 16, "^depth 16 is for"),
    ):
        with pytest.raises(geodisk.InvalidArgument, match=message):
            found.save(tmp_path / name, depth=depth)
    cut = dataclasses.replace(found, distance=found.distance[:1])
    with pytest.raises(geodisk.InvalidArgument, match=r"distance has the shape \(1, 64\)"):
        cut.save(tmp_path / "cut.npy")
    assert not (tmp_path / "cut.npy").exists()


def test_what_cannot_be_baked(pipe, tmp_path):
    samples = geodisk.sample(pipe, count=10)
    bare = tmp_path / "bare.obj"
    bare.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    corner = geodisk.Samples([[0, 0, 0]])
    with pytest.raises(geodisk.InvalidArgument, match="no texture coordinates"):
        geodisk.bake(bare, corner)
    with pytest.raises(FileNotFoundError, match="nowhere.obj"):
        geodisk.bake(tmp_path / "nowhere.obj", corner)
    with pytest.raises(geodisk.InvalidArgument, match="no texture coordinates"):
        geodisk.bake(geodisk.Mesh(bare), corner)
    with pytest.raises(geodisk.InvalidArgument, match="padding is -1, not from 0 to 16384"):
        geodisk.bake(pipe, samples, padding=-1)
    with pytest.raises(geodisk.InvalidArgument, match="size is 0, not from 1 to 16384"):
        geodisk.bake(pipe, samples, size=0)
    for size in (20000, (16, -1), (1, 2, 3)):
        with pytest.raises(geodisk.InvalidArgument, match="size is"):
            geodisk.bake(pipe, samples, size=size)
    with pytest.raises(TypeError, match="size is 1.5, not an integer"):
        geodisk.bake(pipe, samples, size=1.5)
    with pytest.raises(TypeError, match="path"):
        geodisk.bake(geodisk.Mesh(*sheet(4)[::2]), samples)
    with pytest.raises(TypeError, match="Samples"):
        geodisk.bake(pipe, samples.points)
    with pytest.raises(geodisk.InvalidArgument):
        geodisk.bake(pipe, geodisk.Samples([[50.0, 0, 0]]))
