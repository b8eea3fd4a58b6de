"""Runs the program geodisk that was installed with this package."""

from __future__ import annotations

import os
import subprocess
import sys

from . import _cpu
from . import _library as c


def main() -> int:
    path = c.find("bin/geodisk.exe" if sys.platform == "win32" else "bin/geodisk")
    if path is None:
        print("geodisk: this package was installed without the program geodisk", file=sys.stderr)
        return 127
    _cpu.provide()
    command = [path, *sys.argv[1:]]
    if sys.platform == "win32":  # There, execve() returns to the shell before the program ends.
        return subprocess.run(command).returncode
    os.execve(path, command, _cpu.environment())


if __name__ == "__main__":
    sys.exit(main())
