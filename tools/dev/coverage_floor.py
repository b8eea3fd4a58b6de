"""Compares the lines that tests run, by folder, with the least share that each folder must have.

usage: coverage_floor.py LINES.json FLOOR.txt
LINES.json is the JSON summary of gcovr. FLOOR.txt has a folder and a percentage per line. Prints all
folders; fails for one below its floor, and for one that has none.
"""

import json
import pathlib
import sys
from collections import Counter


def folder_of(name: str) -> str:
    """Returns the folder that a file counts for: three names deep in host, else two."""
    parts = pathlib.PurePosixPath(name).parts[:-1]
    return "/".join(parts[: 3 if parts[0] == "host" else 2])


def main() -> None:
    lines, floors = sys.argv[1:]
    covered, total = Counter(), Counter()
    for file in json.loads(pathlib.Path(lines).read_text())["files"]:
        folder = folder_of(file["filename"])
        covered[folder] += file["line_covered"]
        total[folder] += file["line_total"]
    floor = dict(
        line.split() for line in pathlib.Path(floors).read_text().splitlines() if line[:1] not in ("", "#")
    )
    failed = False
    for folder in sorted(total):
        share = 100 * covered[folder] / max(1, total[folder])
        least = floor.get(folder)
        is_low = least is None or share < float(least)
        failed |= is_low
        told = "has no floor" if least is None else f"floor {least}"
        print(f"{folder:32} {covered[folder]:6} of {total[folder]:6} lines {share:6.1f} %  {told}{' FAILED' if is_low else ''}")
    sys.exit(failed)


main()
