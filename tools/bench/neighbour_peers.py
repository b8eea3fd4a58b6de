#!/usr/bin/env python3
"""Measures neighbours of all vertices beside exact codes of others: sources per second.

Takes the distance at which about 30 vertices are in reach. geodisk searches all vertices; others
take some of them, since they go over the whole mesh for each source, or stop once the targets are
reached where they can. Prints a Markdown table, and fails if an exact code gives other distances.

usage: tools/bench/neighbour_peers.py MESH [--reach 30] [--oracle PROGRAM]

Needs the geodisk package (GEODISK_LIBRARY) and numpy; measures what else is installed of libigl,
pygeodesic and potpourri3d. PROGRAM is geodisk_time_oracle of the tests, for CGAL.
"""
import argparse
import importlib
import pathlib
import subprocess
import sys
import tempfile
import time

import geodisk
import numpy as np

SECONDS = 20  # For each of the others.
TOLERANCE = 1e-5  # Of the distance.


def within_for(mesh, reach):
    """The distance at which so many vertices are in reach, on average over some of them."""
    random = np.random.default_rng(1)
    some = np.unique(random.choice(np.unique(mesh.triangles), 300))
    within = np.sqrt(reach * mesh.area / len(np.unique(mesh.triangles)) / np.pi)
    for _ in range(12):
        mean = len(geodisk.neighbours(mesh, sources=some, within=within).indices) / len(some)
        within *= np.sqrt(reach / mean)
    return within


def timed(search, sources):
    """Sources per second, and the sources that were taken in the time."""
    begin = time.perf_counter()
    for count, (source, targets) in enumerate(sources, 1):
        search(source, targets)
        seconds = time.perf_counter() - begin
        if seconds > SECONDS:
            break
    return count / seconds, count


def libigl(vertices, triangles):
    igl = importlib.import_module("igl")
    faces = triangles.astype(np.int64)

    def search(source, targets):
        none = np.empty(0, np.int64)
        return igl.exact_geodesic(vertices, faces, np.array([source]), none, targets, none)

    return search


def pygeodesic(vertices, triangles):
    exact = importlib.import_module("pygeodesic.geodesic")
    paths = exact.PyGeodesicAlgorithmExact(vertices, triangles.astype(np.int32))
    return lambda source, targets: paths.geodesicDistances([source], targets.tolist())[0]


def potpourri3d(vertices, triangles):
    heat = importlib.import_module("potpourri3d").MeshHeatMethodDistanceSolver(vertices, triangles)
    return lambda source, targets: heat.compute_distance(source)[targets]


def check(name, search, sources, near, within):
    """Checks some rows against geodisk's."""
    worst = 0.0
    for source, targets in sources[:5]:
        row = near.distances[near.offsets[source] : near.offsets[source + 1]]
        worst = max(worst, float(np.abs(search(source, targets) - row).max()) / within)
    if name != "potpourri3d" and worst > TOLERANCE:
        sys.exit(f"{name}: distances differ by {worst:.3g} of the distance asked for")
    return worst


def cgal(program, vertices, triangles, within, near, chosen):
    """CGAL's sequence tree goes over the whole mesh; the program tells how long it takes."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "mesh.obj"
        with open(path, "w", encoding="ascii") as out:
            out.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in vertices.tolist())
            out.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles.tolist())
        told = subprocess.run(
            [program, path, str(SECONDS), *map(str, chosen)], check=True, capture_output=True, text=True
        ).stdout.splitlines()
    worst = 0.0
    for line in told[:-1]:
        source, *rest = line.split()
        distances = np.array(rest, float)
        begin, end = near.offsets[int(source)], near.offsets[int(source) + 1]
        row = near.distances[begin:end]
        worst = max(worst, float(np.abs(distances[near.indices[begin:end]] - row).max()) / within)
    if worst > TOLERANCE:
        sys.exit(f"CGAL: distances differ by {worst:.3g} of the distance asked for")
    return float(told[-1]), len(told) - 1, worst


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("mesh")
    parser.add_argument("--reach", type=float, default=30, help="vertices in reach (default 30)")
    parser.add_argument("--oracle", help="geodisk_time_oracle, for CGAL")
    options = parser.parse_args()
    read = geodisk.Mesh(options.mesh)
    used, triangles = np.unique(read.triangles, return_inverse=True)  # Others stumble over the rest.
    triangles = triangles.reshape(-1, 3).astype(np.uint32)
    vertices = np.ascontiguousarray(np.asarray(read.vertices, np.float64)[used])
    mesh = geodisk.Mesh(vertices, triangles)
    within = within_for(mesh, options.reach)
    geodisk.neighbours(mesh, within=within)  # The device is open, the kernels compiled.
    best = np.inf
    for _ in range(3):
        begin = time.perf_counter()
        near = geodisk.neighbours(mesh, within=within)
        best = min(best, time.perf_counter() - begin)
    rate = len(near) / best
    mean = len(near.indices) / len(near)
    print(f"{len(triangles)} triangles, {len(vertices)} vertices, within {within:.6g}: {mean:.1f} in reach\n")
    print("| | sources per second | geodisk is faster by | sources taken | largest difference |")
    print("|---|---|---|---|---|")
    print(f"| geodisk | {rate:,.0f} | | all {len(near):,} | |")
    chosen = np.random.default_rng(2).permutation(len(vertices))[:2000]
    sources = [(int(i), near.indices[near.offsets[i] : near.offsets[i + 1]].astype(np.int64)) for i in chosen]
    if options.oracle:
        of, count, worst = cgal(options.oracle, vertices, triangles, within, near, chosen)
        print(f"| CGAL Surface_mesh_shortest_path | {of:,.3g} | {rate / of:,.0f} | {count} | {worst:.1g} |")
    for name, make in (("libigl", libigl), ("pygeodesic", pygeodesic), ("potpourri3d", potpourri3d)):
        try:
            search = make(vertices, triangles)
        except ImportError:
            print(f"| {name} | not installed | | | |")
            continue
        worst = check(name, search, sources, near, within)
        of, count = timed(search, sources)
        print(f"| {name} | {of:,.3g} | {rate / of:,.0f} | {count} | {worst:.1g} |", flush=True)


if __name__ == "__main__":
    main()
