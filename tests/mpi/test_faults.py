"""A process that has no memory for a message ends all, with one message and without a file."""

import os
import random

import pytest

from launching import ENVIRONMENT, alone, run
from surfaces import torus, write_ply

FAILING = os.environ["GEODISK_FAILING_MESSAGES"]


def run_failing(rank, message, *arguments, processes=3):
    environment = {**ENVIRONMENT, "GEODISK_FAILING_RANK": str(rank),
                   "GEODISK_FAILING_MESSAGE": str(message)}
    return run(processes, *arguments, program=["env", f"LD_PRELOAD={FAILING}"], env=environment)


def without_signal(errors):
    """What is told, but that process 0 was ended: MPI ends it by a signal."""
    return errors.replace("geodisk_mpi: terminated\n", "")


# From the arguments of all, the first that process 0 receives, to the samples of all.
@pytest.mark.parametrize("rank, message", [(0, 1), (0, 4), (0, 9), (1, 1), (1, 4), (2, 3)])
def test_no_memory_for_a_message_of_sampling(tmp_path, rank, message):
    out = tmp_path / "out.ply"
    code, _, errors = run_failing(rank, message, "sample", "builtin:torus-knot", "--min-distance",
                                  "2%", "-o", str(out), "--quiet")
    named = "" if rank == 0 else f"process {rank}: "
    assert (code, without_signal(errors)) == (6, f"geodisk_mpi: {named}out of memory\n")
    assert not list(tmp_path.iterdir())


# From the arguments of all, by messages of ranges, to the last ones of several parts.
@pytest.mark.parametrize("rank, message", [(0, 60), (1, 9), (2, 400), (1, 1500)])
def test_no_memory_for_a_message_of_a_part(tmp_path, rank, message):
    mesh = tmp_path / "torus.ply"
    write_ply(mesh, *torus(30, 16))
    code, _, errors = run_failing(rank, message, "sample", str(mesh), "--min-distance", "4%", "-o",
                                  str(tmp_path / "out.ply"), "--parts", "3", "--quiet")
    named = "" if rank == 0 else f"process {rank}: "
    assert (code, without_signal(errors)) == (6, f"geodisk_mpi: {named}out of memory\n")
    assert list(tmp_path.iterdir()) == [mesh]


@pytest.mark.parametrize("rank, message", [(0, 3), (2, 2)])
def test_no_memory_for_a_message_of_verifying(tmp_path, rank, message):
    samples = tmp_path / "samples.csv"
    alone("builtin:torus-knot", "--count", "300", "-o", str(samples))
    code, output, errors = run_failing(rank, message, "verify", "builtin:torus-knot", str(samples))
    named = "" if rank == 0 else f"process {rank}: "
    assert (code, output) == (6, "")
    assert without_signal(errors) == f"geodisk_mpi: {named}out of memory\n"


@pytest.mark.skipif("GEODISK_TERMINATING_METIS" not in os.environ, reason="no shared METIS")
def test_terminated_while_the_surface_is_divided(tmp_path):
    mesh, out = tmp_path / "torus.ply", tmp_path / "out.ply"
    write_ply(mesh, *torus(500, 200))
    chance = random.Random(1)
    delays = [0, 100, 1000] + [chance.randrange(300_000) for _ in range(6)]
    for delay in delays:
        environment = {**ENVIRONMENT, "GEODISK_TERMINATING_MICROSECONDS": str(delay)}
        preload = f"LD_PRELOAD={os.environ['GEODISK_TERMINATING_METIS']}"
        # Features need the whole surface, which METIS divides.
        code, _, errors = run(3, "sample", str(mesh), "--min-distance", "3%", "--features", "60",
                              "-o", str(out), "--quiet", program=["env", preload],
                              env=environment)
        assert (code, errors) == (143, "geodisk_mpi: terminated\n"), delay
        assert list(tmp_path.iterdir()) == [mesh]
