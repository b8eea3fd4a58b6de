"""--checkpoint and --resume: a run that was killed goes on, and writes the same file."""

import json
import os
import shutil
import signal

import pytest

from launching import alone, children_of, launch, run, wait_for
from surfaces import torus, write_ply

# Long enough to be killed after its first checkpoint.
JOB = ["builtin:torus-knot", "--min-distance", "0.6%", "--seed", "5"]
NAME = "geodisk-1.checkpoint"


def kill_after_checkpoint(folder, out, arguments, processes):
    """Kills a process once there is a checkpoint. No file appears."""
    process = launch(processes, "sample", *arguments, "-o", str(out), "--quiet", "--checkpoint",
                     str(folder))
    wait_for((folder / NAME).exists, process)
    os.kill(children_of(process)[-1], signal.SIGKILL)
    process.communicate(timeout=60)
    assert process.returncode != 0 and not out.exists()


@pytest.fixture(scope="module")
def killed(tmp_path_factory):
    """The folder of a run that was killed, and the file that it should have written."""
    work = tmp_path_factory.mktemp("killed")
    alone(*JOB, "-o", str(work / "expected.ply"))
    kill_after_checkpoint(work / "saved", work / "out.ply", JOB, 3)
    return work / "saved", (work / "expected.ply").read_bytes()


@pytest.fixture
def saved(killed, tmp_path):
    shutil.copytree(killed[0], tmp_path / "saved")
    return tmp_path / "saved"


def resume(saved, out, processes=2, job=JOB):
    return run(processes, "sample", *job, "-o", str(out), "--quiet", "--checkpoint", str(saved),
               "--resume")


@pytest.mark.parametrize("processes", [1, 2, 4])
def test_goes_on_with_any_number_of_processes(killed, saved, tmp_path, processes):
    out = tmp_path / "out.ply"
    code, _, errors = resume(saved, out, processes)
    assert code == 0, errors
    assert out.read_bytes() == killed[1]
    assert not list(saved.iterdir())


def test_killed_again_while_it_goes_on(killed, saved, tmp_path):
    out = tmp_path / "out.ply"
    before = (saved / NAME).read_bytes()
    process = launch(2, "sample", *JOB, "-o", str(out), "--quiet", "--checkpoint", str(saved),
                     "--resume")
    wait_for(lambda: (saved / NAME).read_bytes() != before, process)
    os.kill(children_of(process)[0], signal.SIGKILL)
    process.communicate(timeout=60)
    assert not out.exists()
    code, _, errors = resume(saved, out, 3)
    assert code == 0, errors
    assert out.read_bytes() == killed[1]


def test_levels_go_on(tmp_path):
    job = ["builtin:torus-knot", "--count", "5000", "--order", "progressive"]
    alone(*job, "-o", str(tmp_path / "expected.csv"))
    folder, out = tmp_path / "saved", tmp_path / "out.csv"
    process = launch(2, "sample", *job, "-o", str(out), "--quiet", "--checkpoint", str(folder))
    wait_for((folder / "geodisk-2.checkpoint").exists, process)
    os.kill(children_of(process)[-1], signal.SIGKILL)
    process.communicate(timeout=60)
    code, _, errors = resume(folder, out, 3, job)
    assert code == 0, errors
    assert out.read_bytes() == (tmp_path / "expected.csv").read_bytes()
    assert not list(folder.iterdir())


def test_run_that_is_not_killed_leaves_no_checkpoint(tmp_path):
    job = ["builtin:cube", "--min-distance", "5%"]
    for stages in ["1", "3"]:
        out = tmp_path / f"{stages}.ply"
        code, _, errors = run(3, "sample", *job, "-o", str(out), "--quiet", "--checkpoint",
                              str(tmp_path / "saved"), "--checkpoint-stages", stages)
        assert code == 0, errors
        assert not list((tmp_path / "saved").iterdir())
    alone(*job, "-o", str(tmp_path / "expected.ply"))
    for stages in ["1", "3"]:
        assert (tmp_path / f"{stages}.ply").read_bytes() == \
            (tmp_path / "expected.ply").read_bytes()


def write_warm_torus(path, swaps=False, heats=1.0):
    """A torus with a density, perhaps with two faces swapped."""
    vertices, faces = torus(300, 100)
    if swaps:
        faces[0], faces[7] = faces[7], faces[0]
    heat = [heats * (1.6 + x) for x, _, _ in vertices]
    heat[0] = 1
    write_ply(path, vertices, faces, of_vertices={"heat": heat})


@pytest.fixture(scope="module")
def in_ranges(tmp_path_factory):
    """A job on a mesh that is read in ranges, the folder of a run of it that was killed, and the file
    that it should have written."""
    work = tmp_path_factory.mktemp("ranges")
    write_warm_torus(work / "torus.ply")
    job = [str(work / "torus.ply"), "--min-distance", "0.5%", "--seed", "5", "--density", "heat",
           "--mask", "y<1.2"]
    alone(*job, "-o", str(work / "expected.ply"))
    kill_after_checkpoint(work / "saved", work / "out.ply", [*job, "--parts", "2"], 3)
    return job, work / "saved", (work / "expected.ply").read_bytes()


@pytest.mark.parametrize("processes, more", [
    (1, []), (3, []), (2, ["--parts", "3"]), (2, ["--picture", "picture.png"])])
def test_goes_on_in_ranges(in_ranges, tmp_path, monkeypatch, processes, more):
    """With other parts, and where process 0 has to read the whole now."""
    job, killed, expected = in_ranges
    monkeypatch.chdir(tmp_path)
    shutil.copytree(killed, "saved")
    code, _, errors = run(processes, "sample", *job, *more, "-o", "out.ply", "--checkpoint",
                          "saved", "--resume", "--json", "report.json")
    assert code == 0, errors
    assert "going on from" in errors
    shares = json.loads((tmp_path / "report.json").read_text())["processes"]
    assert all((share["part_bytes"] > 0) == ("--picture" in more) for share in shares)
    assert (tmp_path / "out.ply").read_bytes() == expected
    assert not list((tmp_path / "saved").iterdir())


def test_ranges_go_on_from_a_run_on_the_whole(in_ranges, tmp_path):
    job, _, expected = in_ranges
    saved, out = tmp_path / "saved", tmp_path / "out.ply"
    kill_after_checkpoint(saved, out, [*job, "--picture", str(tmp_path / "picture.png")], 2)
    code, _, errors = resume(saved, out, 3, job)
    assert code == 0, errors
    assert out.read_bytes() == expected


@pytest.mark.parametrize("change", [{"swaps": True}, {"heats": 1.1}])
def test_another_mesh_in_ranges_is_refused(in_ranges, tmp_path, change):
    job, killed, _ = in_ranges
    saved, out = tmp_path / "saved", tmp_path / "out.ply"
    shutil.copytree(killed, saved)
    write_warm_torus(tmp_path / "other.ply", **change)
    code, _, errors = resume(saved, out, 3, [str(tmp_path / "other.ply"), *job[1:]])
    assert code == 3 and errors.count("\n") == 1, errors
    assert "is of another mesh" in errors and not out.exists() and (saved / NAME).exists()


def digest(data):
    """As checkpoint_file.cpp has it."""
    value = 0xcbf29ce484222325
    for word in [len(data), *(int.from_bytes(data[i:i + 8], "little")
                              for i in range(0, len(data), 8))]:
        value = (value ^ word) * 0x100000001b3 % 2**64
        value ^= value >> 32
    return value.to_bytes(8, "little")


def flipped(data):
    middle = len(data) // 2
    return data[:middle] + bytes([data[middle] ^ 1]) + data[middle + 1:]


def of_another_version(data):
    end = data.index(b"\n")
    other = data[:end] + b".1" + data[end:-8]
    return other + digest(other)


def test_the_digest_of_this_test_is_right(saved):
    data = (saved / NAME).read_bytes()
    assert digest(data[:-8]) == data[-8:]


@pytest.mark.parametrize("change, message", [
    (flipped, "is damaged"),
    (lambda data: data[:-1], "is damaged"),
    (lambda data: data[:100], "is damaged"),
    (lambda data: b"", "is no checkpoint"),
    (lambda data: data + b"x", "is damaged"),
    (of_another_version, "was written by another version"),
])
def test_damaged_checkpoints_are_refused(saved, tmp_path, change, message):
    path = saved / NAME
    path.write_bytes(change(path.read_bytes()))
    before = path.read_bytes()
    out = tmp_path / "out.ply"
    code, _, errors = resume(saved, out)
    assert code == 3 and errors.count("\n") == 1, errors
    assert str(path) in errors and message in errors
    assert not out.exists() and path.read_bytes() == before


@pytest.mark.parametrize("job, message", [
    (["builtin:torus-knot:20", *JOB[1:]], "is of another mesh"),
    ([*JOB[:-1], "6"], "is of a run with other options"),
    ([*JOB, "--pool-ratio", "30"], "is of a run with other options"),
    (["builtin:torus-knot", "--min-distance", "0.61%", "--seed", "5"],
     "is of a run with other options"),
])
def test_checkpoints_of_another_run_are_refused(saved, tmp_path, job, message):
    out = tmp_path / "out.ply"
    code, _, errors = resume(saved, out, job=job)
    assert code == 3 and errors.count("\n") == 1, errors
    assert NAME in errors and message in errors
    assert not out.exists() and (saved / NAME).exists()


def test_what_there_is_must_be_as_asked(saved, tmp_path):
    out = str(tmp_path / "out.ply")
    code, _, errors = resume(tmp_path / "none", out)
    assert code == 2 and errors.count("\n") == 1 and "has no checkpoint" in errors
    code, _, errors = run(2, "sample", *JOB, "-o", out, "--checkpoint", str(saved))
    assert code == 2 and errors.count("\n") == 1 and "add --resume" in errors
    code, _, errors = run(2, "sample", *JOB, "-o", out, "--resume")
    assert code == 2 and errors.count("\n") == 1 and "--checkpoint" in errors
    file = tmp_path / "file"
    file.write_text("")
    code, _, errors = run(2, "sample", *JOB, "-o", out, "--checkpoint", str(file / "in"))
    assert code == 4 and errors.count("\n") == 1, errors


def test_a_checkpoint_that_cannot_be_written_ends_all(tmp_path):
    out, folder = tmp_path / "out.ply", tmp_path / "saved"
    process = launch(2, "sample", *JOB, "-o", str(out), "--quiet", "--checkpoint", str(folder))
    wait_for(folder.exists, process)
    folder.rmdir()
    folder.write_text("no folder any more")
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 4 and errors.count("\n") == 1, errors
    assert NAME in errors and not out.exists()
