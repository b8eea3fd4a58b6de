"""The program geodisk, for what the library does not do."""

from __future__ import annotations

import contextlib
import functools
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from typing import Iterator, Sequence

from . import _cpu, _place
from . import _errors as e
from . import _library as c
from ._wording import in_python

_NAME = "geodisk.exe" if sys.platform == "win32" else "geodisk"
_HOW_TO_GET_IT = (
    "it comes with the wheel, with the Debian package geodisk and with a build of the sources "
    "(tools/quickstart), and is looked for in the environment variable GEODISK_COMMAND, in this "
    "package, beside Python and in PATH"
)

# By exit status, as `geodisk --help` has them; 1 means something to verify alone.
_FAILURES: dict[int, tuple[type[e.Error], str]] = {
    2: (e.InvalidArgument, "invalid_argument"),
    3: (e.InvalidArgument, "invalid_argument"),
    5: (e.NoDevice, "no_device"),
    6: (e.OutOfMemory, "out_of_host_memory"),
    129: (e.Cancelled, "cancelled"),
    130: (e.Cancelled, "cancelled"),
    131: (e.Cancelled, "cancelled"),
    143: (e.Cancelled, "cancelled"),
}


def bundled() -> str | None:
    """Path of the program that was installed with this package."""
    return _place.find(f"bin/{_NAME}")


def _find() -> str:
    named = os.environ.get("GEODISK_COMMAND")
    if named:
        path = shutil.which(named)
        if path is None:
            raise e.NoProgram(f"GEODISK_COMMAND is {named}, which is no program", "no_program")
        return os.path.abspath(path)
    path = (
        bundled()
        or shutil.which(_NAME, path=sysconfig.get_path("scripts"))
        or shutil.which(_NAME)
    )
    if path is None:
        raise e.NoProgram(f"there is no program {_NAME}: {_HOW_TO_GET_IT}", "no_program")
    return os.path.abspath(path)


@functools.lru_cache(maxsize=8)
def _check(path: str) -> None:
    """Both are to know the same formats and options."""
    try:
        told = subprocess.run(
            [path, "--version"], stdin=subprocess.DEVNULL, capture_output=True, text=True
        ).stdout.partition("\n")[0]
    except OSError as error:
        raise e.NoProgram(f"{path} does not run: {error}", "no_program") from error
    if told != f"geodisk {c.version()}":
        raise e.NoProgram(
            f"{path} is {told or 'no program of geodisk'}, but this package is of geodisk "
            f"{c.version()}: {_HOW_TO_GET_IT}",
            "no_program",
        )


@contextlib.contextmanager
def folder() -> Iterator[pathlib.Path]:
    """One for the files of a run, which nobody else reads and which ends with the run."""
    with tempfile.TemporaryDirectory(prefix="geodisk-") as path:
        yield pathlib.Path(path)


def run(folder: pathlib.Path, arguments: Sequence[str], accepted: Sequence[int] = (0,)) -> None:
    """Runs the program in `folder` with names of files there; raises what it fails with.

    What interrupts Python, such as Ctrl-C, ends the program.
    """
    program = _find()
    _check(program)
    try:
        ended = subprocess.run(
            [program, *arguments, "--quiet"],
            cwd=folder,
            env=_cpu.environment(),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            errors="replace",
        )
    except OSError as error:
        raise e.NoProgram(f"{program} does not run: {error}", "no_program") from error
    if ended.returncode in accepted:
        return
    kind, status = _FAILURES.get(ended.returncode, (e.Error, "internal"))
    told = _message(ended.stderr)
    with _cpu.advice():
        raise kind(told or f"{program} ended with status {ended.returncode}", status)


def _message(told: str) -> str:
    """Returns the error that the program printed, in words of this package."""
    lines = [line for line in told.splitlines() if not line.startswith("geodisk: warning:")]
    message = in_python(" ".join(lines).replace("geodisk: ", "", 1))
    return re.sub(r"\.(ply|txt)\b", "", message)  # Files are called after what they hold.
