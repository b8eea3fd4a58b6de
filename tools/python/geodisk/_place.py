"""Where this package is installed."""

from __future__ import annotations

import pathlib
import sys


def find(name: str) -> str | None:
    """Path of a file of the package. An editable installation has binaries apart from the modules."""
    for folder in sys.modules[__package__].__path__:
        path = pathlib.Path(folder, name)
        if path.exists():
            return str(path)
    return None
