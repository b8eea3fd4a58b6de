"""The programs of host/docs/guides.md, run as their readers run them, and what they leave behind."""

import csv
import json
import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import geodisk

SOURCE = pathlib.Path(__file__).parents[2]
GUIDES = SOURCE / "tools/examples/guides"
COMMAND = pathlib.Path(os.environ["GEODISK_COMMAND"])
ENVIRONMENT = os.environ | {"PATH": f"{COMMAND.parent}{os.pathsep}{os.environ['PATH']}"}


def run(*command):
    done = subprocess.run(
        [str(part) for part in command],
        env=ENVIRONMENT,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "geodisk: " not in done.stderr  # Drivers may have something to say.
    return done.stdout


def run_guide(name, folder):
    start = [sys.executable] if name.endswith(".py") else []
    return run(*start, GUIDES / name, folder)


def verified(*files):
    run(COMMAND, "verify", *files, "--quiet")


@pytest.fixture
def folder(tmp_path):
    """A folder that the programs make."""
    return tmp_path / "new" / "folder"


def test_trees(folder):
    run_guide("trees.py", folder)
    verified(folder / "terrain.obj", folder / "samples.csv")
    with open(folder / "trees.csv") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == ["x", "y", "z", "nx", "ny", "nz", "scale", "turn"]
    x, y, z, nx, ny, nz, scale, turn = np.array([list(row.values()) for row in rows], float).T
    assert 1000 < len(rows) and z.min() > -20 - 1e-3
    assert np.allclose(nx**2 + ny**2 + nz**2, 1, atol=1e-4) and nz.min() > 0
    assert 0.3 < scale.min() < 0.4 and 0.7 < scale.max() <= 1
    assert 0 <= turn.min() and turn.max() <= 360
    # Trees on flat ground stand closer.
    assert np.median(scale[nz > 0.99]) < 0.6 * np.median(scale[nz < 0.8])


def test_training(folder):
    run_guide("training.py", folder)
    epochs = [np.load(folder / f"epoch-{k}.npz") for k in range(3)]
    for epoch in epochs:
        points = epoch["points"]
        assert points.shape == epoch["normals"].shape == epoch["barycentric"].shape == (2048, 3)
        assert np.array_equal(epoch["label"], epoch["face_index"].astype(int) * 4 // 9216)
        # On the torus, and in each resolution spread over all of it.
        outer = np.hypot(points[:, 0], points[:, 1]) - 2
        assert np.allclose(np.hypot(outer, points[:, 2]), 1, atol=0.005)
        for n in epoch["resolutions"]:
            counts = np.bincount(epoch["label"][:n], minlength=4)
            assert counts.min() > 0.7 * n / 4 and counts.max() < 1.3 * n / 4
    assert not np.array_equal(epochs[0]["face_index"], epochs[1]["face_index"])


def test_remesh(folder):
    run_guide("remesh.py", folder)
    lines = [line.split() for line in open(folder / "coarse.obj")]
    vertices = [line for line in lines if line[0] == "v"]
    triangles = [tuple(int(at) for at in line[1:]) for line in lines if line[0] == "f"]
    # Closed, oriented and a torus still.
    edges = {(face[k - 1], face[k]) for face in triangles for k in range(3)}
    assert len(edges) == 3 * len(triangles)
    assert {(b, a) for a, b in edges} == edges
    assert {at for face in triangles for at in face} == set(range(1, len(vertices) + 1))
    assert 250 < len(vertices) and len(vertices) - len(edges) / 2 + len(triangles) == 0


def test_tile(folder):
    run_guide("tile.sh", folder)
    verified(folder / "tile.csv")
    text = (folder / "tile.csv").read_text()
    rows = [line for line in text.splitlines() if not line.startswith("#")]
    points = np.array([row.split(",") for row in rows[1:]], float)
    assert points.shape == (1000, 2) and 0 <= points.min() and points.max() < 1
    # Distances go around.
    between = points[:, None] - points[None]
    between = np.linalg.norm(between - np.round(between), axis=-1)
    np.fill_diagonal(between, 9)
    assert between.min() >= 0.0253
    assert (folder / "spectrum.csv").stat().st_size > 0


def test_scene(folder):
    run_guide("scene.sh", folder)
    plants = geodisk.read(folder / "plants.ply")
    kinds = np.bincount(plants.classes)
    assert kinds[0] >= 40 and kinds[2] > kinds[1] > kinds[0]
    assert plants.columns["existing"].sum() == 40 and plants.points[:, 2].min() > 0
    scene = (folder / "plants.usda").read_text()
    assert scene.count("def Mesh") == 3 and 'upAxis = "Z"' in scene


def test_cluster(folder):
    run_guide("cluster.sh", folder)
    logs = sorted((folder / "samples").glob("batch-*-of-3.jsonl"))
    entries = [[json.loads(line) for line in open(log)] for log in logs]
    assert [len(entry) for entry in entries] == [2, 2, 2]
    meshes = sorted((folder / "meshes").iterdir())
    assert len(meshes) == 6
    assert json.loads((folder / "all.json").read_text())["skipped"] == 6
    for mesh in meshes:
        verified(mesh, folder / "samples" / mesh.name)
