"""Runs geodisk_mpi under mpirun, and geodisk alone to compare with."""

import os
import subprocess
import time

PROGRAM = os.environ["GEODISK_MPI_COMMAND"]
ENVIRONMENT = {
    **os.environ,
    "LP_NUM_THREADS": "1",
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
}

def launch(processes, *arguments, program=(), within=(), env=ENVIRONMENT):
    """Starts mpirun; `program` is what geodisk_mpi is started by, and `within` what mpirun is."""
    command = [*within, os.environ["GEODISK_MPIEXEC"], "-q", "-n", str(processes), *program, PROGRAM,
               *arguments]
    return subprocess.Popen(command, env=env, text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE)


def run(processes, *arguments, **more):
    process = launch(processes, *arguments, **more)
    output, errors = process.communicate(timeout=120)
    return process.returncode, output, errors


def alone(*arguments):
    subprocess.run([os.environ["GEODISK_COMMAND"], "sample", *arguments, "--quiet"], check=True,
                   env=ENVIRONMENT)


def children_of(process):
    """The processes of geodisk_mpi that mpirun started."""
    listed = subprocess.run(["ps", "--no-headers", "-o", "pid", "--ppid", str(process.pid)],
                            text=True, capture_output=True).stdout.split()
    return [int(pid) for pid in listed]


def wait_for(happens, process=None, seconds=60):
    """Waits until happens() is true, while the process runs."""
    deadline = time.monotonic() + seconds
    while not happens():
        assert time.monotonic() < deadline
        assert process is None or process.poll() is None, process.communicate()
        time.sleep(0.01)
