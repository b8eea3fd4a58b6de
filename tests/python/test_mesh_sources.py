"""Meshes from files and polygons: those of the program."""

import base64
import copy
import json
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
    for arguments in ({"attributes": "mask"}, {"columns": "mesh"}, {"mesh_format": "obj"}):
        with pytest.raises(TypeError, match="files"):
            geodisk.Mesh(VERTICES, FACES, **arguments)


def test_the_format_is_told(tmp_path):
    write_obj(tmp_path / "cube.txt", CUBE, SIDES)
    expected = geodisk.sample(CUBE, SIDES, min_distance=0.3)
    assert same(geodisk.sample(tmp_path / "cube.txt", mesh_format="obj", min_distance=0.3), expected)
    many = geodisk.sample_many([tmp_path / "cube.txt"], mesh_format="obj", min_distance=0.3)
    assert same(many[0], expected)
    with pytest.raises(geodisk.MeshRejected, match="or give mesh_format"):
        geodisk.Mesh(tmp_path / "cube.txt")
    with pytest.raises(geodisk.InvalidArgument, match="mesh_format: 'doc' is none of"):
        geodisk.Mesh(tmp_path / "cube.txt", mesh_format="doc")


def write_gltf(path):
    """Two triangles by one primitive each, the second one placed by two nodes."""
    points = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], "<f4").tobytes()
    uri = "data:application/octet-stream;base64," + base64.b64encode(points).decode()
    document = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(points), "uri": uri}],
        "bufferViews": [{"buffer": 0, "byteLength": len(points)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}] * 2,
        "nodes": [{"mesh": 0}, {"mesh": 1, "translation": [3, 0, 0]}, {"mesh": 1, "translation": [6, 0, 0]}],
    }
    path.write_text(json.dumps(document))


@pytest.mark.filterwarnings("ignore::geodisk.MeshWarning")
def test_columns_of_triangles(tmp_path):
    path = tmp_path / "three.gltf"
    write_gltf(path)
    names = ["mesh", "node", "primitive"]
    mesh = geodisk.Mesh(path, columns=names)
    assert {name: column.tolist() for name, column in mesh.columns.items()} == {
        "mesh": [0, 1, 1],
        "node": [0, 1, 2],
        "primitive": [0, 0, 0],
    }
    samples = geodisk.sample(path, columns=names, min_distance=0.3)
    assert samples.columns["node"].tolist() == samples.face_index.tolist()
    assert set(geodisk.sample(path, columns="mesh,node", min_distance=1).columns) == {"mesh", "node"}
    many = geodisk.sample_many([path, path], columns=names, min_distance=[0.3, 0.5])
    assert [one.columns["node"].tolist() for one in many] == [one.face_index.tolist() for one in many]
    assert samples[3].columns["node"] == samples.face_index[3]
    assert samples[::2].columns["node"].tolist() == samples.face_index[::2].tolist()
    assert pickle.loads(pickle.dumps(mesh)).columns["mesh"].tolist() == [0, 1, 1]
    for name in ("a.npz", "a.csv", "a.ply"):
        samples.save(tmp_path / name)
        again = geodisk.read(tmp_path / name).columns
        assert set(again) == set(names) and all((again[n] == samples.columns[n]).all() for n in names)
    for asked, kind, text in [
        (["mesh", "meshes"], geodisk.InvalidArgument, "columns: 'meshes' is none of"),
        (["mesh", "mesh"], geodisk.InvalidArgument, "columns: mesh is given twice"),
    ]:
        with pytest.raises(kind, match=text):
            geodisk.Mesh(path, columns=asked)
    with pytest.raises(geodisk.MeshRejected, match="does not have the mesh of a face"):
        geodisk.Mesh(CASES / "sphere.stl", columns=["mesh"])
    with pytest.raises(TypeError, match="give columns, attributes and mesh_format"):
        geodisk.sample(mesh, columns=["mesh"], min_distance=1)
    with pytest.raises(TypeError, match="^mesh 1: .*give columns, attributes and mesh_format"):
        geodisk.sample_many([path, mesh], columns=["mesh"], min_distance=1)
    with pytest.raises(geodisk.InvalidArgument, match="'x' is none of"):
        geodisk.Samples(np.zeros((2, 3)), columns={"x": [1, 2]})


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


@pytest.mark.filterwarnings("ignore::geodisk.MeshWarning")
def test_values_of_faces_count_those_that_make_no_triangle():
    mesh = geodisk.Mesh(CUBE, [*SIDES, [], [0, 1]])
    assert len(mesh.triangles) == 12
    first = np.arange(8) == 0
    masked = geodisk.sample(mesh, min_distance=0.1, face_mask=first)
    assert set(masked.face_index.tolist()) == {0, 1}
    assert set(masked.interpolate(np.arange(8) + 5, of="faces").tolist()) == {5}
    assert geodisk.Mesh(CUBE, [*SIDES, [], [0, 1]], walls=first).area == 5
    assert len(geodisk.sample(mesh, min_distance=0.2, density=np.arange(8) + 1)) > 0
    for wrong in (np.ones(7, bool), np.ones(40, bool)):
        with pytest.raises(geodisk.InvalidArgument, match=r"face_mask has the shape \((7|40),\), not \(12,\)"):
            geodisk.sample(mesh, min_distance=0.1, face_mask=wrong)
    two = geodisk.Mesh(CUBE, [SIDES[0], [0, 1]])  # Two faces as given, and two triangles.
    assert set(geodisk.sample(two, min_distance=0.1, face_mask=[True, False]).face_index.tolist()) == {0, 1}


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
