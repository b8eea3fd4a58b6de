"""geodisk_mpi under mpirun: the files of `geodisk sample`, and what ends a run."""

import json
import os
import signal
import subprocess
import time

import pytest

from launching import ENVIRONMENT, PROGRAM, alone, children_of, launch, run, wait_for
from surfaces import torus, write_ply

MESH = "builtin:torus-knot"


def check_same(tmp_path, arguments, counts, name="samples.ply"):
    expected = tmp_path / f"alone-{name}"
    alone(*arguments, "-o", str(expected))
    for count in counts:
        found = tmp_path / f"{count}-{name}"
        code, _, errors = run(count, "sample", *arguments, "-o", str(found), "--quiet")
        assert (code, errors) == (0, "")
        assert found.read_bytes() == expected.read_bytes(), count


def test_same_file_for_any_number_of_processes(tmp_path):
    check_same(tmp_path, [MESH, "--min-distance", "1.5%", "--seed", "3"], [1, 2, 3, 4, 7])


def test_same_file_with_radii_and_constraints(tmp_path):
    existing = tmp_path / "existing.csv"
    alone(MESH, "--count", "50", "--seed", "9", "-o", str(existing))
    check_same(tmp_path, [MESH, "--radius-factor", "curvature", "--count", "300"], [3], "radii.csv")
    check_same(tmp_path, [MESH, "--min-distance", "3%", "--existing", str(existing), "--avoid",
                          f"{existing}:4%"], [3], "given.csv")
    check_same(tmp_path, ["builtin:cube", "--min-distance", "10%", "--features", "30"], [2],
               "features.csv")
    check_same(tmp_path, [MESH, "--count", "150", "--min-distance", "2%", "--method", "darts"],
               [3], "darts.csv")
    check_same(tmp_path, [MESH, "--count", "150", "--order", "progressive", "--exact"], [2],
               "levels.csv")


def test_same_file_where_each_process_reads_a_range(tmp_path):
    vertices, faces = torus(30, 12)
    mesh = tmp_path / "torus.ply"
    write_ply(mesh, vertices, faces, of_vertices={"heat": [2 + x for x, _, _ in vertices]})
    for arguments in [["--density", "heat"], ["--mask", "x>0"]]:
        check_same(tmp_path, [str(mesh), *arguments, "--count", "100"], [2])


def test_report_tells_of_processes(tmp_path):
    report = tmp_path / "report.json"
    code, _, errors = run(3, "sample", MESH, "--count", "300", "-o", str(tmp_path / "s.ply"),
                          "--json", str(report), "--quiet")
    assert (code, errors) == (0, "")
    told = json.loads(report.read_text())
    processes = told["processes"]
    assert len(processes) == 3
    assert sum(p["samples"] for p in processes) == told["samples"]
    assert sum(p["candidates"] for p in processes) == told["candidates"]
    assert sum(p["own_faces"] for p in processes) == told["mesh"]["triangles"]
    assert len({p["rounds"] for p in processes}) == 1
    assert all(p["messages"] == p["rounds"] * p["neighbours"] for p in processes)


@pytest.mark.parametrize("arguments, message", [
    (["--count", "10", "--classes", "2"], "geodisk_mpi and --classes exclude each other"),
    (["--count", "10", "--maximal"], "geodisk_mpi and --maximal exclude each other"),
    (["--count", "10", "--metric", "euclidean"], "geodisk_mpi and --metric euclidean exclude each other"),
    (["--count", "0"], "--count"),
    ([], "give one of --min-distance"),
])
def test_bad_options_are_told_once(tmp_path, arguments, message):
    out = tmp_path / "s.ply"
    code, _, errors = run(2, "sample", "builtin:cube", "-o", str(out), *arguments)
    assert code == 2
    assert errors.startswith("geodisk_mpi: ") and message in errors
    assert errors.count("\n") == 1 and not out.exists()


def test_more_processes_than_faces(tmp_path):
    mesh = tmp_path / "one.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n")
    out = tmp_path / "s.ply"
    code, _, errors = run(3, "sample", str(mesh), "--min-distance", "0.2", "-o", str(out))
    assert code == 2 and errors.count("\n") == 1 and not out.exists()
    assert "there are 3 processes, but the mesh has 2 faces" in errors
    code, _, errors = run(3, "sample", str(tmp_path / "none.obj"), "--count", "5", "-o", str(out))
    assert code == 3 and errors.count("\n") == 1 and "none.obj" in errors


def test_processes_started_differently(tmp_path):
    out = str(tmp_path / "s.ply")
    first = ["-n", "1", PROGRAM, "sample", "builtin:cube", "--count", "10", "-o", out]
    other = ["-n", "1", PROGRAM, "sample", "builtin:cube", "--count", "20", "-o", out]
    done = subprocess.run([os.environ["GEODISK_MPIEXEC"], "-q", *first, ":", *other],
                          env=ENVIRONMENT, text=True, capture_output=True, timeout=60)
    assert done.returncode == 2 and not os.path.exists(out)
    assert done.stderr.startswith("geodisk_mpi: process 1 was started with other arguments")
    assert done.stderr.count("\n") == 1


def test_killed_process_ends_all(tmp_path):
    out = tmp_path / "s.ply"
    process = launch(3, "sample", MESH, "--count", "3000000", "-o", str(out), "--quiet")
    wait_for(lambda: len(children_of(process)) == 3)
    time.sleep(1)
    pids = children_of(process)
    os.kill(pids[-1], signal.SIGKILL)
    process.communicate(timeout=30)
    assert process.returncode != 0
    assert not out.exists() and not list(tmp_path.iterdir())
    assert not children_of(process)
