#!/usr/bin/env python3
"""Measures one source and all vertices by geodisk and by pygeodesic, side by side.

usage: tools/bench/distance_peers.py [--runs N] MESH...
Needs the Python packages geodisk and pygeodesic. A MESH is a file or builtin:NAME. Prints a table of
seconds of processor time, the best of N runs, and the largest difference as a part of the distance.
"""

import argparse
import time

import numpy as np
import pygeodesic.geodesic

import geodisk


def best(runs, measure):
    """Returns the least processor time of some runs, and the result of one."""
    times = []
    for _ in range(runs):
        begin = time.process_time()
        result = measure()
        times.append(time.process_time() - begin)
    return min(times), result


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    print("| Mesh | Triangles | geodisk | pygeodesic | factor | Largest difference |")
    print("|---|---|---|---|---|---|")
    for name in options.meshes:
        mesh = geodisk.Mesh(name)
        used, triangles = np.unique(mesh.triangles, return_inverse=True)
        vertices = mesh.vertices[used].astype(np.float64)
        triangles = triangles.reshape(-1, 3)
        exact = pygeodesic.geodesic.PyGeodesicAlgorithmExact(vertices, triangles)
        own, distances = best(options.runs, lambda: geodisk.geodesic_distances(mesh, int(used[0])))
        other, (found, _) = best(options.runs, lambda: exact.geodesicDistances(np.array([0]), None))
        distances = distances[used]
        is_far = np.isfinite(distances) & (found > 0) & (found < 1e30)
        difference = np.abs(distances[is_far] - found[is_far]) / found[is_far]
        print(
            f"| {name} | {len(triangles):,} | {own:.3f} | {other:.3f} | {other / own:.1f} "
            f"| {difference.max():.0e} |"
        )


if __name__ == "__main__":
    main()
