"""Files that the processes of geodisk_mpi write together, each a part of the rows."""

import os
import re
import subprocess

import pytest

from launching import ENVIRONMENT, alone, launch, run
from surfaces import torus, write_ply

FEW = ["--min-distance", "60%"]  # Not a sample for each process.
MANY = ["--min-distance", "3%"]


@pytest.fixture
def mesh(tmp_path):
    path = tmp_path / "torus.ply"
    write_ply(path, *torus(60, 24))
    return str(path)


def expected(tmp_path, mesh, name, *arguments):
    path = tmp_path / f"alone-{name}"
    alone(mesh, "-o", str(path), *arguments)
    return path.read_bytes()


def in_namespace():
    """What starts a program whose mounts are its own."""
    start = ["unshare", "--mount"] if os.geteuid() == 0 else ["unshare", "--map-root-user", "--mount"]
    probe = subprocess.run([*start, "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True)
    if probe.returncode != 0:
        pytest.skip("this system lets nobody mount")
    return start


@pytest.mark.parametrize("name, more", [
    ("a.ply", []), ("a.ply", ["--ascii"]), ("a.ply", ["--no-header"]), ("a.csv", []),
    ("a.csv", ["--no-header"]), ("a.xyz", []), ("a.npz", []), ("a.obj", []), ("a.pcd", [])])
def test_same_bytes_in_all_formats(tmp_path, mesh, name, more):
    wanted = expected(tmp_path, mesh, name, *MANY, *more)
    report = tmp_path / "report.json"
    path = tmp_path / name
    code, _, errors = run(3, "sample", mesh, "-o", str(path), *MANY, *more, "--quiet", "--json",
                          str(report))
    assert (code, errors) == (0, "")
    assert path.read_bytes() == wanted
    assert '"samples": 0' not in report.read_text()


def test_fewer_samples_than_processes(tmp_path, mesh):
    wanted = expected(tmp_path, mesh, "few.csv", *FEW)
    path = tmp_path / "few.csv"
    code, _, errors = run(7, "sample", mesh, "-o", str(path), *FEW, "--quiet", "--parts", "2")
    assert (code, errors) == (0, "")
    assert path.read_bytes() == wanted


def test_to_a_stream(tmp_path, mesh):
    wanted = expected(tmp_path, mesh, "stream.csv", *MANY)
    process = launch(3, "sample", mesh, "-o", "-", "--format", "csv", *MANY, "--quiet")
    output, errors = process.communicate(timeout=120)
    assert (process.returncode, errors) == (0, "")
    assert output.encode() == wanted


def test_processes_that_do_not_see_the_file(tmp_path, mesh):
    folder = tmp_path / "own"
    folder.mkdir()
    hides = [*in_namespace(), "sh", "-c", 'mount -t tmpfs none "$0" && exec "$@"', str(folder)]
    path = folder / "hidden.csv"
    wanted = expected(tmp_path, mesh, "hidden.csv", *MANY)
    first_sees = ["sh", "-c", f'[ "$OMPI_COMM_WORLD_RANK" != 0 ] || shift {len(hides)}; exec "$@"',
                  "sh", *hides]
    environment = {**ENVIRONMENT, "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}
    code, _, errors = run(3, "sample", mesh, "-o", str(path), *MANY, "--quiet", program=first_sees,
                          env=environment)
    assert (code, errors) == (0, "")
    assert path.read_bytes() == wanted
    assert os.listdir(folder) == ["hidden.csv"]


def test_full_disk(tmp_path, mesh):
    folder = tmp_path / "full"
    folder.mkdir()
    path = folder / "full.csv"
    wanted = expected(tmp_path, mesh, "full.csv", *MANY)
    assert len(wanted) > 40000
    small = [*in_namespace(), "sh", "-c",
             'mount -t tmpfs -o size=32k none "$0" && "$@"; code=$?; ls -A "$0"; exit $code',
             str(folder)]
    code, output, errors = run(3, "sample", mesh, "-o", str(path), *MANY, "--quiet", within=small)
    assert code == 4
    assert output == ""
    (line,) = errors.splitlines()
    # Whichever process comes last finds it full.
    told = re.escape(f"geodisk_mpi: {path}: cannot write: ")
    assert re.fullmatch(told + r"(process [12]: )?No space left on device", line)
