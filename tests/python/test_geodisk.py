"""The Python package: the samples of the program, arrays of all kinds, and what goes wrong."""

import os
import signal
import subprocess
import sys
import threading
import time
import warnings

import numpy as np
import pytest

import geodisk
from meshes import FACES, LENGTHS, TETRAHEDRON, VERTICES, same


def test_samples_are_complete_and_apart():
    samples = geodisk.sample(VERTICES, FACES, min_distance=0.3, seed=5)
    n = len(samples)
    assert n > 300
    assert samples.points.shape == samples.normals.shape == samples.barycentric.shape == (n, 3)
    assert samples.points.dtype == np.float64 and samples.face_index.dtype == np.uint32
    assert np.array_equal(samples.order, np.arange(n))
    corners = VERTICES[FACES[samples.face_index]]
    assert np.allclose((samples.barycentric[:, :, None] * corners).sum(axis=1), samples.points)
    assert np.allclose(np.linalg.norm(samples.normals, axis=1), 1)
    assert np.allclose(samples.barycentric.sum(axis=1), 1)
    assert np.all(samples.radius == 0.15) and samples.min_distance == 0.3
    # Straight lines are shorter than ways along the surface, but a little, at this distance.
    between = np.linalg.norm(samples.points[:, None] - samples.points[None], axis=-1)
    np.fill_diagonal(between, 9)
    assert between.min() > 0.28
    assert samples.report["samples"] == n and 0.6 < samples.report["rho"] < 0.8


@pytest.mark.skipif("GEODISK_COMMAND" not in os.environ, reason="needs the program")
def test_samples_are_those_of_the_program(tmp_path):
    # By text that is exact, since the program reads a file.
    with open(tmp_path / "torus.obj", "w") as file:
        file.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in VERTICES.tolist())
        file.writelines(f"f {a} {b} {c}\n" for a, b, c in (FACES + 1).tolist())
    command = os.environ["GEODISK_COMMAND"]
    for options, arguments in [
        (["--min-distance", "0.4", "--seed", "9"], {"min_distance": 0.4, "seed": 9}),
        (["--count", "200"], {"count": 200}),
        (["-d", "0.4", "--metric", "euclidean"], {"min_distance": 0.4, "metric": "euclidean"}),
    ]:
        subprocess.run(
            [command, "sample", "torus.obj", "-o", "a.csv", "-q", *options],
            cwd=tmp_path,
            check=True,
        )
        lines = [l for l in open(tmp_path / "a.csv") if not l.startswith("#")]
        rows = np.loadtxt(lines[1:], delimiter=",")
        samples = geodisk.sample(VERTICES, FACES, **arguments)
        assert np.array_equal(rows[:, :3], samples.points)
        assert np.array_equal(rows[:, 6], samples.face_index)

    # What is saved here is read there.
    samples.save(tmp_path / "b.csv")
    samples = geodisk.sample(VERTICES, FACES, min_distance=0.4)
    samples.save(tmp_path / "b.csv")
    subprocess.run(
        [command, "verify", "torus.obj", "b.csv", "-q"], cwd=tmp_path, check=True
    )


def test_samples_are_no_mesh(tmp_path):
    samples = geodisk.sample("builtin:cube", count=20)
    for name in ("a.ply", "a.csv", "a.npz", "a.obj", "a.glb"):
        samples.save(tmp_path / name)
        with pytest.raises(geodisk.MeshRejected, match="holds samples, but a mesh is expected here"):
            geodisk.Mesh(tmp_path / name)


def test_arrays_of_all_kinds():
    expected = geodisk.sample(VERTICES, FACES, min_distance=0.5)
    wide = np.zeros((len(VERTICES), 7))
    wide[:, 2:5] = VERTICES
    for vertices, faces in [
        (wide[:, 2:5], FACES),
        (np.asfortranarray(VERTICES), FACES),
        (VERTICES.tolist(), FACES.tolist()),
        (VERTICES, FACES.astype(np.uint16)),
        (VERTICES, FACES.astype(np.int32)),
        (VERTICES, FACES.astype(np.uint32)),
        (VERTICES, np.asfortranarray(FACES.astype(np.uint32))),
        (VERTICES.astype(">f8"), FACES.astype(">i4")),
        (np.repeat(VERTICES, 2, axis=0)[::2], FACES[::-1][::-1]),
    ]:
        assert same(geodisk.sample(vertices, faces, min_distance=0.5), expected)
    frozen = VERTICES.copy(), FACES.astype(np.uint32)
    for array in frozen:
        array.setflags(write=False)
    assert same(geodisk.sample(*frozen, min_distance=0.5), expected)
    single = VERTICES.astype(np.float32)
    assert same(
        geodisk.sample(single, FACES, min_distance=0.5),
        geodisk.sample(single.astype(np.float64), FACES, min_distance=0.5),
    )


def test_meshes_of_other_packages():
    class Trimesh:
        vertices, faces = VERTICES, FACES

    class Open3D:
        vertices, triangles = VERTICES, FACES

    expected = geodisk.sample(VERTICES, FACES, min_distance=0.5)
    mesh = geodisk.Mesh(Trimesh())
    assert same(geodisk.sample(mesh, min_distance=0.5), expected)
    assert same(geodisk.sample(Open3D(), min_distance=0.5), expected)
    assert mesh.info["faces"] == len(FACES) and mesh.info["boundary_edges"] == 0
    with pytest.raises(TypeError, match="a mesh is"):
        geodisk.sample("nonsense".encode(), min_distance=0.5)
    with pytest.raises(FileNotFoundError, match="nowhere.obj"):
        geodisk.sample("nowhere.obj", min_distance=0.5)
    with pytest.raises(TypeError, match="already"):
        geodisk.sample(mesh, FACES, min_distance=0.5)


def test_options():
    every = geodisk.sample(VERTICES, FACES, min_distance=0.4)
    assert same(geodisk.sample(VERTICES, FACES, radius=0.2), every)
    first = geodisk.sample(VERTICES, FACES, min_distance=0.4, stop_count=50)
    assert np.array_equal(first.face_index, every.face_index[:50])
    assert not same(geodisk.sample(VERTICES, FACES, min_distance=0.4, seed=2**64 - 1), every)
    keyed = geodisk.sample(
        VERTICES, FACES, min_distance=0.4, face_keys=np.arange(len(FACES))[::-1]
    )
    assert not same(keyed, every)
    mask = np.arange(len(FACES)) % 3 == 0
    masked = geodisk.sample(VERTICES, FACES, min_distance=0.4, face_mask=mask)
    assert mask[masked.face_index].all() and 20 < len(masked) < len(every)
    chosen = np.nonzero(mask)[0]
    assert same(
        geodisk.sample(VERTICES, FACES, min_distance=0.4, face_mask=chosen.tolist()), masked
    )
    counted = geodisk.sample(VERTICES, FACES, count=100, face_mask=chosen)
    assert len(counted) in range(95, 106) and mask[counted.face_index].all()
    factors = np.linspace(0.3, 1, len(VERTICES))
    varied = geodisk.sample(VERTICES, FACES, min_distance=0.6, radius_factor=factors)
    assert 0.09 <= varied.radius.min() < 0.15 and varied.radius.max() <= 0.3
    lengths = np.linalg.norm(VERTICES[np.roll(FACES, -1, axis=1)] - VERTICES[FACES], axis=-1)
    bare = geodisk.sample(len(VERTICES), FACES, edge_lengths=lengths, min_distance=0.4)
    assert bare.points is None and bare.normals is None and len(bare) > 100
    soup = VERTICES[FACES].reshape(-1, 3), np.arange(3 * len(FACES)).reshape(-1, 3)
    assert same(geodisk.sample(*soup, min_distance=0.4, weld=True), every)
    assert same(geodisk.sample(*soup, min_distance=0.4), every)
    assert geodisk.Mesh(*soup).info["joined_edges"] == 3 * len(FACES)
    walled = geodisk.Mesh(*soup, walls=np.zeros(len(FACES), bool))
    assert walled.info["joined_edges"] == 3 * len(FACES)
    kept = geodisk.Mesh(*soup, keep_seams=True)
    assert kept.info["joined_edges"] == 0 and kept.info["components"] == len(FACES)
    with pytest.raises(geodisk.InvalidArgument, match="^weld and keep_seams contradict"):
        geodisk.Mesh(*soup, keep_seams=True, weld=True)
    plane = geodisk.sample([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]], min_distance=0.1)
    assert plane.points.shape[1] == 2 and plane.normals is None


def test_an_exact_count_keeps_the_first_samples_of_a_run():
    mesh = geodisk.Mesh(VERTICES, FACES)
    samples = geodisk.sample(mesh, count=200, exact=True, seed=3)
    assert len(samples) == samples.report["samples"] == 200
    whole = geodisk.sample(mesh, min_distance=samples.min_distance, seed=3)
    assert len(whole) == 200 + samples.report["cut"] <= 202
    assert np.array_equal(whole.points[:200], samples.points)
    many = geodisk.sample_many([mesh, mesh], count=[200, 30], exact=True, seed=3)
    assert np.array_equal(many[0].points, samples.points) and len(many[1]) == 30
    again = geodisk.sample(mesh, count=201, exact=True, existing=samples)
    assert len(again) == 201 and again.columns["existing"].sum() == 200
    assert len(geodisk.sample_box([1, 2], count=77, exact=True)) == 77
    for wrong in [
        dict(min_distance=0.1),
        dict(count=10.5),
        dict(count=2**32),
        dict(count=10, stop_count=5),
    ]:
        with pytest.raises(ValueError, match="exact"):
            geodisk.sample(mesh, exact=True, **wrong)
    with pytest.raises(ValueError, match="no distance tried gave more than 0 of 5 samples"):
        geodisk.sample(mesh, count=5, exact=True, avoid=(samples[:9], 99.0))


def test_progressive_order_fills_level_after_level(tmp_path):
    square = geodisk.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    samples = geodisk.sample(square, min_distance=0.03, order="progressive", seed=3)
    distances = samples.level_distances
    assert len(distances) >= 3 and distances[-1] == 0.03
    assert np.allclose(distances, 0.03 * 2.0 ** np.arange(len(distances))[::-1])
    assert (np.diff(samples.level.astype(int)) >= 0).all()
    for level, distance in enumerate(distances):
        points = samples.points[samples.level <= level]  # In the plane, paths are straight.
        apart = np.linalg.norm(points[:, None] - points, axis=2) + 9 * np.eye(len(points))
        assert apart.min() >= distance
        plain = geodisk.sample(square, min_distance=distance, seed=3)
        assert len(plain) * 0.85 <= len(points) <= len(plain) * 1.15
        assert level > 0 or np.array_equal(plain.points, points)
        told = samples.report["levels"][level]
        assert told == {"min_distance": distance, "samples": len(points)}
    found = geodisk.verify(samples)
    assert found.ok and found.level_violations == (0,) * len(distances)
    samples.save(tmp_path / "a.csv")
    again = geodisk.read(tmp_path / "a.csv")
    assert again.level_distances == distances
    assert np.array_equal(again.level, samples.level) and again[3].columns["level"] == 0
    exact = geodisk.sample(square, count=200, exact=True, order="progressive", levels=2)
    assert len(exact) == 200 and exact.level.max() == 1
    more = geodisk.sample(square, count=300, existing=exact, order="progressive", level_factor=1.5)
    assert more.columns["existing"].sum() == 200 and geodisk.verify(more).ok
    assert len(geodisk.sample(square, count=200, order="progressive", stop_count=30)) == 30
    for wrong in [
        dict(order="random"),
        dict(levels=2),
        dict(order="progressive", levels=0),
        dict(order="progressive", level_factor=1.0),
    ]:
        with pytest.raises(ValueError, match="order|levels|level_factor"):
            geodisk.sample(square, min_distance=0.1, **wrong)


def test_a_count_with_a_stop_is_searched_for_without_it():
    all_samples = geodisk.sample(VERTICES, FACES, count=200, seed=3)
    first = geodisk.sample(VERTICES, FACES, count=200, stop_count=20, seed=3)
    assert first.min_distance == all_samples.min_distance
    assert np.array_equal(first.face_index, all_samples.face_index[:20])
    assert first.report["missing"] == 0 and first.report["samples"] == 20
    with pytest.warns(geodisk.GeodiskWarning, match="only .* of 1,000,000 samples fit"):
        short = geodisk.sample(VERTICES, FACES, min_distance=0.4, stop_count=10**6)
    assert short.report["missing"] == 10**6 - len(short)
    with pytest.warns(geodisk.GeodiskWarning, match="only .* of 999 samples fit"):
        geodisk.sample_box([1, 1], min_distance=0.2, stop_count=999)
    with pytest.raises(ValueError, match="darts"):
        geodisk.sample(VERTICES, FACES, count=200, darts=100)


def told(call, *arguments, **options):
    """Kinds of the warnings about samples."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        call(*arguments, **options)
    own = [one for one in caught if not isinstance(one.message, geodisk.MeshWarning)]
    assert all(issubclass(one.category, geodisk.GeodiskWarning) for one in own)
    assert all(one.filename == __file__ and "--" not in str(one.message) for one in own)
    return [one.message.kind for one in own]


def test_sets_are_warned_of_as_the_program_does():
    apart = np.concatenate([VERTICES[FACES[:9]] + 9 * i for i in range(3)])
    loose = (apart.reshape(-1, 3), np.arange(3 * len(apart)).reshape(-1, 3))
    assert told(geodisk.sample, VERTICES, FACES, count=200) == []
    assert told(geodisk.sample, *loose, count=2) == ["count_missed"]
    assert told(geodisk.sample, *loose, min_distance=9) == ["single_samples"]
    few = geodisk.Mesh(*loose)
    assert told(geodisk.sample, few, min_distance=0.05, stop_count=2) == ["bare_parts"]
    assert told(geodisk.sample, VERTICES, FACES, min_distance=99) == ["single_samples"]
    lengths = {"edge_lengths": LENGTHS, "radius": 99}
    assert told(geodisk.sample, len(VERTICES), FACES, **lengths) == ["single_samples"]
    assert told(geodisk.sample_box, [1, 1], min_distance=9) == ["single_samples"]
    with pytest.warns(geodisk.GeodiskWarning, match="mesh 1: there is a single sample"):
        geodisk.sample_many([(VERTICES, FACES), TETRAHEDRON], min_distance=[0.5, 99])


def test_what_leaves_out_nothing_is_warned_of():
    for kind, how in [
        ("mask_of_all", {"face_mask": np.ones(len(FACES), bool)}),
        ("constant_density", {"density": np.full(len(VERTICES), 7)}),
    ]:
        with pytest.warns(geodisk.GeodiskWarning) as heard:
            geodisk.sample(VERTICES, FACES, min_distance=0.4, **how)
            many = {name: [values] for name, values in how.items()}
            geodisk.sample_many([(VERTICES, FACES)], min_distance=0.4, **many)
        assert [one.message.kind for one in heard].count(kind) == 2


def test_density():
    x = VERTICES[:, 0] - VERTICES[:, 0].min()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        samples = geodisk.sample(VERTICES, FACES, count=400, density=x)
        mask = geodisk.sample(VERTICES, FACES, min_distance=0.3, density=x > x.max() / 2)
    assert 380 < len(samples) < 420
    middle = VERTICES[:, 0].min() + x.max() / 2
    assert (samples.points[:, 0] > middle).mean() > 0.6
    assert samples.min_distance == pytest.approx(2 * samples.radius.min(), rel=0.05)
    in_mask = (x > x.max() / 2)[FACES].any(axis=1)
    assert len(mask) > 50 and in_mask[mask.face_index].all()
    assert mask.min_distance == mask.report["min_distance"] == 0.3
    assert same(geodisk.sample(VERTICES, FACES, count=400, density=1000 * x), samples)
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # Its unit does not matter.
        geodisk.sample(VERTICES, FACES, min_distance=0.5, density=np.linspace(0.3, 1, len(x)))


def test_boxes():
    samples = geodisk.sample_box([1, 2], min_distance=0.1, periodic=True)
    assert samples.points.shape[1] == 2 and samples.face_index is None
    apart = np.abs(samples.points[:, None] - samples.points[None])
    apart = np.minimum(apart, [1, 2] - apart)
    between = np.linalg.norm(apart, axis=-1)
    np.fill_diagonal(between, 9)
    assert between.min() >= 0.1
    assert abs(len(geodisk.sample_box([1, 1, 1], count=300)) - 300) <= 15
    with pytest.raises(geodisk.InvalidArgument, match="dimension"):
        geodisk.sample_box([1] * 7, min_distance=0.1)


@pytest.mark.parametrize(
    "vertices, faces, kind, text",
    [
        (TETRAHEDRON[0].astype(complex), TETRAHEDRON[1], TypeError, "complex"),
        (np.array([["a", "b", "c"]]), TETRAHEDRON[1], TypeError, "real numbers"),
        (TETRAHEDRON[0], TETRAHEDRON[1].astype(float), TypeError, "integers"),
        (TETRAHEDRON[0].ravel(), TETRAHEDRON[1], ValueError, "shape"),
        (TETRAHEDRON[0][:, :1], TETRAHEDRON[1], ValueError, "shape"),
        (TETRAHEDRON[0], TETRAHEDRON[1].ravel(), ValueError, "shape"),
        (TETRAHEDRON[0], TETRAHEDRON[1][:, :2], ValueError, "shape"),
        (TETRAHEDRON[0], TETRAHEDRON[1] - 1, geodisk.MeshRejected, "-1"),
        (TETRAHEDRON[0], TETRAHEDRON[1].astype(np.int32) - 1, geodisk.MeshRejected, "-1"),
        (TETRAHEDRON[0], TETRAHEDRON[1] + 2**32, geodisk.MeshRejected, "4294967"),
        (TETRAHEDRON[0], TETRAHEDRON[1] + 1, geodisk.MeshRejected, "4"),
        (TETRAHEDRON[0] * np.nan, TETRAHEDRON[1], geodisk.MeshRejected, "finite"),
        (TETRAHEDRON[0] * np.inf, TETRAHEDRON[1], geodisk.MeshRejected, "finite"),
        (TETRAHEDRON[0] * 0, TETRAHEDRON[1], geodisk.MeshRejected, "area"),
        (np.zeros((0, 3)), np.zeros((0, 3), int), geodisk.MeshRejected, "face"),
        ([], [], ValueError, "shape"),
    ],
)
def test_bad_meshes(vertices, faces, kind, text):
    with pytest.raises(kind, match=text):
        geodisk.sample(vertices, faces, min_distance=0.2)


def test_bad_values():
    def fails(kind, text, **arguments):
        with pytest.raises(kind, match=text):
            geodisk.sample(*TETRAHEDRON, **{"min_distance": 0.2, **arguments})

    for value in (0, -1, np.nan, np.inf):
        fails(ValueError, "positive", min_distance=value)
    fails(ValueError, "one of", radius=0.1)
    fails(ValueError, "one of", min_distance=None)
    fails(ValueError, "count", min_distance=None, count=0)
    fails(ValueError, "seed", seed=-1)
    fails(ValueError, "seed", seed=2**64)
    fails(TypeError, "integer", seed=0.5)
    fails(ValueError, "pool", pool_ratio=0.5)
    fails(ValueError, "metric", metric="manhattan")
    fails(ValueError, "shape", density=[1, 1])
    fails(ValueError, "vertex 2 .* -2", density=[1, 1, -2, 1])
    fails(ValueError, "0 everywhere", density=[0, 0, 0, 0])
    fails(ValueError, "0.001", radius_factor=[1, 1, 2, 1])
    fails(ValueError, "contradict", density=[1, 1, 1, 1], radius_factor=[1, 1, 1, 1])
    fails(ValueError, "shape", face_keys=[1, 2])
    fails(ValueError, "alike", face_keys=[1, 2, 2, 3])
    fails(ValueError, r"shape \(3,\), not \(4,\)", face_mask=[True, False, True])
    fails(ValueError, "triangle 4, the mesh has 4; a mask of zeros", face_mask=[0, 4])
    for count in (0, -1, 0.5, float("nan"), float("inf")):
        fails(ValueError, "not a number of at least 1", min_distance=None, count=count)
    fails(TypeError, "count is '9', not a number", min_distance=None, count="9")
    fails(ValueError, "pool_ratio is 0, not from", pool_ratio=0)
    fails(ValueError, "levels is 33, not from 1 to 32", order="progressive", levels=33)
    fails(ValueError, "features is True, not an angle", features=True)
    point = ([0], [[1, 0, 0]])
    fails(ValueError, "point to avoid 0 has the radius nan", avoid=(point, float("nan")))
    fails(ValueError, "mask of zeros and ones, which must be of type bool", face_mask=[0, 1, 1, 0])
    fails(ValueError, "leaves out all faces", face_mask=[False] * 4)
    fails(ValueError, "leaves out all faces", face_mask=[])
    fails(TypeError, "integers", face_mask=[0.5, 1.0, 0.0, 1.0])
    fails(geodisk.NoDevice, "nowhere", device="nowhere")
    rejected = TETRAHEDRON[1].copy()
    rejected[2, 1] = 77
    with pytest.raises(geodisk.MeshRejected) as caught:
        geodisk.sample(TETRAHEDRON[0], rejected, min_distance=0.2)
    assert caught.value.element == 2 and caught.value.status == "mesh_rejected"


def test_progress_and_interruption():
    seen = []
    samples = geodisk.sample(
        VERTICES, FACES, count=3000, progress=lambda part, n: seen.append((part, n))
    )
    assert len(seen) > 2 and all(0 <= part <= 1 for part, _ in seen)
    assert seen[-1][1] <= len(samples)

    def raises(part, n):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        geodisk.sample(VERTICES, FACES, min_distance=0.05, progress=raises)

    def cancels(part, n):
        raise geodisk.Cancelled("enough of it")

    inner = []

    def samples_itself(part, n):  # Another run, while this one is in progress.
        inner.append(len(geodisk.sample(*TETRAHEDRON, min_distance=0.5)))
        return len(inner) < 2

    for callback, text in [
        (cancels, "enough of it"),
        (lambda part, n: False, "returned False"),
        (lambda part, n: np.bool_(False), "returned False"),
        (samples_itself, "returned False"),
    ]:
        with pytest.raises(geodisk.Cancelled, match=text):
            geodisk.sample(VERTICES, FACES, min_distance=0.01, progress=callback)
        assert len(geodisk.sample(*TETRAHEDRON, min_distance=0.5)) > 10  # This thread goes on.
    assert inner[0] == inner[1]

    # Ctrl-C, while some run is in progress.
    timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        while True:
            geodisk.sample(VERTICES, FACES, min_distance=0.008)
    timer.join()
    assert len(geodisk.sample(VERTICES, FACES, min_distance=0.5)) > 100


def test_threads():
    expected = geodisk.sample(VERTICES, FACES, min_distance=0.4)
    mesh = geodisk.Mesh(VERTICES, FACES)
    found, ticks = [], []
    threads = [
        threading.Thread(target=lambda: found.append(geodisk.sample(mesh, min_distance=0.4)))
        for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):  # Others run on: the lock is released.
        ticks.append(time.monotonic())
        time.sleep(0.001)
    assert len(found) == 4 and all(same(one, expected) for one in found)
    assert ticks


def test_devices_and_children(monkeypatch):
    found = geodisk.devices()
    assert any(device.usable for device in found)
    assert geodisk.sample(*TETRAHEDRON, min_distance=0.5, device=found[0].index)
    usable = next(device for device in found if device.usable)
    expected = geodisk.sample(*TETRAHEDRON, min_distance=0.5)
    for device in (usable, usable.index, np.int64(usable.index), usable.uuid, usable.name):
        assert same(geodisk.sample(*TETRAHEDRON, min_distance=0.5, device=device), expected)
    monkeypatch.setenv("GEODISK_DEVICE", "nowhere")
    with pytest.raises(geodisk.NoDevice, match="GEODISK_DEVICE is nowhere"):
        geodisk.sample(*TETRAHEDRON, min_distance=0.5)
    assert same(geodisk.sample(*TETRAHEDRON, min_distance=0.5, device=usable), expected)
    monkeypatch.setenv("GEODISK_DEVICE", usable.uuid)
    assert same(geodisk.sample(*TETRAHEDRON, min_distance=0.5), expected)
    monkeypatch.delenv("GEODISK_DEVICE")
    # A child that was forked opens a device of its own.
    code = (
        "import os, sys, geodisk\n"
        "n = len(geodisk.sample_box(min_distance=0.1))\n"
        "child = os.fork()\n"
        "if child == 0: os._exit(0 if len(geodisk.sample_box(min_distance=0.1)) == n else 1)\n"
        "sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))\n"
    )
    assert subprocess.run([sys.executable, "-c", code], timeout=60).returncode == 0


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="needs on_exit()")
@pytest.mark.parametrize("who", ["parent", "child", "parent and child"])
def test_children_end_as_programs_end(who):
    code = (
        "import os, sys, geodisk\n"
        f"if 'parent' in {who!r}: geodisk.sample_box(min_distance=0.2)\n"
        "child = os.fork()\n"
        "if child == 0:\n"
        f"    if 'child' in {who!r}: geodisk.sample_box(min_distance=0.2)\n"
        "    print('from the child', end='')\n"
        "    sys.exit(3)\n"
        "sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))\n"
    )
    ended = subprocess.run([sys.executable, "-c", code], timeout=60, capture_output=True)
    assert ended.returncode == 3 and ended.stdout == b"from the child"


@pytest.mark.parametrize("variable", ["VK_ICD_FILENAMES", "VK_DRIVER_FILES"])
def test_driver_files_that_are_missing_are_named(variable):
    code = (
        "import geodisk\n"
        "try: geodisk.devices()\n"
        "except geodisk.NoDevice as error: print(error)\n"
    )
    environment = {**os.environ, variable: "/nowhere/driver.json"}
    if variable == "VK_ICD_FILENAMES":
        environment.pop("VK_DRIVER_FILES", None)  # Which the loader would take.
    told = subprocess.run(
        [sys.executable, "-c", code], env=environment, timeout=60, capture_output=True, text=True
    ).stdout
    assert variable in told and "/nowhere/driver.json, which does not exist" in told


def test_masks_of_parts(tmp_path):
    path = tmp_path / "m.obj"
    path.write_text(
        "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n"
        "usemtl wood\nf 1 2 5 4\nusemtl steel\nf 2 3 6 5\n"
    )
    mesh = geodisk.Mesh(path, columns=["material", "part"])
    assert mesh.columns["material"].tolist() == [0, 0, 1, 1]
    assert mesh.columns["part"].tolist() == [0, 0, 0, 0]
    steel = geodisk.sample(mesh, min_distance=0.2, face_mask=mesh.columns["material"] == 1)
    assert steel.points[:, 0].min() >= 1 and (steel.columns["material"] == 1).all()
    whole = geodisk.sample(mesh, min_distance=0.2, face_mask=[False, True])  # By polygons.
    assert same(whole, steel)
    steel.save(tmp_path / "a.npz")
    assert (geodisk.read(tmp_path / "a.npz").columns["material"] == 1).all()
