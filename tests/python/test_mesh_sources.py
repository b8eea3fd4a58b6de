"""Meshes from files and polygons: those of the program."""

import copy
import os
import pathlib
import pickle
import signal
import subprocess
import threading
import time

import numpy as np
import pytest

import geodisk
from geodisk._background import interruptible
from meshes import FACES, VERTICES, same

CASES = pathlib.Path(__file__).parents[1] / "data" / "cases"

CUBE = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
SIDES = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]


def write_obj(path, vertices, faces):
    with open(path, "w") as file:
        file.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in np.asarray(vertices).tolist())
        file.writelines("f " + " ".join(str(v + 1) for v in face) + "\n" for face in faces)


def write_off(path, vertices, faces):
    with open(path, "w") as file:
        file.write(f"OFF\n{len(vertices)} {len(faces)} 0\n")
        file.writelines(f"{x!r} {y!r} {z!r}\n" for x, y, z in np.asarray(vertices).tolist())
        file.writelines(f"{len(face)} " + " ".join(map(str, face)) + "\n" for face in faces)


def write_ply(path, vertices, faces):
    with open(path, "w") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {len(vertices)}\n")
        file.write("property double x\nproperty double y\nproperty double z\n")
        file.write(f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
        file.writelines(f"{x!r} {y!r} {z!r}\n" for x, y, z in np.asarray(vertices).tolist())
        file.writelines(f"{len(face)} " + " ".join(map(str, face)) + "\n" for face in faces)


def of_the_program(folder, mesh, *options):
    """The samples that the program writes."""
    command = [os.environ["GEODISK_COMMAND"], "sample", str(mesh), "-o", "there.npz", "-q", *options]
    subprocess.run(command, cwd=folder, check=True)
    return geodisk.read(folder / "there.npz")


@pytest.mark.skipif("GEODISK_COMMAND" not in os.environ, reason="needs the program")
@pytest.mark.filterwarnings("ignore::geodisk.MeshWarning")
@pytest.mark.parametrize(
    "name, distance",
    [
        ("sphere.stl", 0.2),
        ("g_quant_u16.gltf", 0.3),
        ("quads.obj", 0.2),
        ("mixed.ply", 0.2),
        ("quads.off", 0.2),
        ("builtin:torus-knot:8", 0.4),
    ],
)
def test_files_are_read_as_the_program_reads_them(tmp_path, name, distance):
    writers = {".obj": write_obj, ".ply": write_ply, ".off": write_off}
    mesh = CASES / name
    if name.startswith("builtin:"):
        mesh = name
    elif not mesh.exists():
        mesh = tmp_path / name
        faces = [*SIDES[1:], SIDES[0][:3], [0, 3, 1]] if name == "mixed.ply" else SIDES
        writers[mesh.suffix](mesh, CUBE, faces)
    expected = of_the_program(tmp_path, mesh, "-d", str(distance), "--seed", "3")
    found = geodisk.sample(mesh, min_distance=distance, seed=3)
    assert len(found) > 30 and np.array_equal(found.face_index, expected.face_index)
    assert np.allclose(found.points, expected.points, rtol=0, atol=1e-6)


def test_what_a_file_has(tmp_path):
    mesh = geodisk.Mesh(CASES / "mask01.ply", attributes=["mask"])
    mask = mesh.attributes["mask"]
    assert set(mask) == {0, 1} and len(mask) == len(mesh.vertices)
    assert mesh.triangles.max() < len(mesh.vertices)
    with pytest.raises(ValueError):
        mask[0] = 7  # It is the file's.
    del mesh  # Arrays keep what they need.
    assert set(mask) == {0, 1}
    (tmp_path / "bad.obj").write_text("v 0 0 0\nv 1 0 0\nf 1 2 3\n")
    for path, kind, text in [
        (tmp_path / "nowhere.obj", FileNotFoundError, "nowhere.obj"),
        (tmp_path / "bad.obj", geodisk.MeshRejected, "bad.obj: line 3: vertex index 3"),
        (tmp_path / "bad.xyz", FileNotFoundError, "bad.xyz"),
        (tmp_path, geodisk.MeshRejected, ""),
        ("builtin:nothing", geodisk.InvalidArgument, "nothing"),
    ]:
        with pytest.raises(kind, match=text):
            geodisk.Mesh(path)
    with pytest.raises(geodisk.MeshRejected, match="nosuch"):
        geodisk.Mesh(CASES / "mask01.ply", attributes=["nosuch"])
    with pytest.raises(TypeError, match="files"):
        geodisk.Mesh(VERTICES, FACES, attributes=["mask"])


def test_polygons_are_split_as_those_of_files(tmp_path):
    write_off(tmp_path / "quads.off", CUBE, SIDES)
    read = geodisk.Mesh(tmp_path / "quads.off")
    expected = geodisk.sample(read, min_distance=0.2)
    for faces in (SIDES, np.array(SIDES), np.array(SIDES, np.uint16), [tuple(f) for f in SIDES]):
        mesh = geodisk.Mesh(CUBE, faces)
        assert np.array_equal(mesh.triangles, read.triangles)
        assert mesh.polygons.tolist() == [i // 2 for i in range(12)]
        assert same(geodisk.sample(mesh, min_distance=0.2), expected)
    ragged = [*SIDES[1:], [0, 2, 3], [0, 3, 1]]
    mesh = geodisk.Mesh(CUBE.tolist(), ragged)
    assert mesh.polygons.tolist() == [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 6] and mesh.area == 6
    flat = geodisk.Mesh([[0, 0], [2, 0], [2, 1], [1, 3], [0, 1]], [[0, 1, 2, 3, 4]])
    assert flat.area == pytest.approx(4) and flat.vertices.shape == (5, 2)
    assert geodisk.Mesh(VERTICES, FACES).polygons is None


@pytest.mark.parametrize(
    "faces, kind, text",
    [
        ([[0, 1, 2, 9]], geodisk.MeshRejected, "face 0 names vertex 9, but there are 8"),
        ([[0, 1, 3, -1]], geodisk.MeshRejected, "-1"),
        ([[0, 1, 3], [0, 1, 3, 8]], geodisk.MeshRejected, "face 1 names vertex 8"),
        ([[0, 1, 2.5], [0, 1, 3, 2]], TypeError, "face 0 is not"),
        ([[0, 1, 3], 7], TypeError, "face 1 is not"),
        ([[0, 0, 1, 1]], geodisk.MeshRejected, "area"),
        ([[0, 1], [0, 1, 3, 2]], None, ""),
    ],
)
@pytest.mark.filterwarnings("ignore::geodisk.MeshWarning")
def test_odd_polygons(faces, kind, text):
    if kind is None:
        assert geodisk.Mesh(CUBE, faces).area == 1
        return
    with pytest.raises(kind, match=text):
        geodisk.Mesh(CUBE, faces)


def test_meshes_are_pickled_and_copied():
    mesh = geodisk.Mesh(CUBE, SIDES)
    expected = geodisk.sample(mesh, min_distance=0.3)
    for again in (pickle.loads(pickle.dumps(mesh)), copy.copy(mesh), copy.deepcopy(mesh)):
        assert again.info == mesh.info and np.array_equal(again.polygons, mesh.polygons)
        assert same(geodisk.sample(again, min_distance=0.3), expected)
    lengths = np.ones((4, 3))
    bare = geodisk.Mesh(4, [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]], edge_lengths=lengths)
    assert pickle.loads(pickle.dumps(bare)).area == bare.area


def test_long_calls_are_interrupted():
    ended = threading.Event()

    def work(stop):
        while stop.value == 0:
            time.sleep(0.01)
        ended.set()

    timer = threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        interruptible(work)
    timer.join()
    assert ended.is_set()
    assert interruptible(lambda stop: 7) == 7
    with pytest.raises(RuntimeError, match="within"):
        interruptible(lambda stop: (_ for _ in ()).throw(RuntimeError("within")))
