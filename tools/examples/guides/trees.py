"""Trees on a terrain: close together where it is flat, far apart on slopes, none under water.

usage: python3 trees.py FOLDER
Writes terrain.obj, trees.csv, a row per tree for an instancer, and samples.csv for `geodisk verify`.
"""

import pathlib
import sys

import geodisk
import numpy as np

folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)

# A terrain of 1000 m x 1000 m by heights on a grid; yours may be any mesh.
n = 81
x, y = np.meshgrid(np.linspace(0, 1000, n), np.linspace(0, 1000, n), indexing="ij")
z = 60 * np.sin(x / 130) * np.cos(y / 170) + 15 * np.sin((x + 2 * y) / 60)
vertices = np.stack([x, y, z], axis=-1).reshape(-1, 3)
i, j = np.meshgrid(np.arange(n - 1), np.arange(n - 1), indexing="ij")
at = i * n + j
faces = np.stack([at, at + n, at + n + 1, at, at + n + 1, at + 1], axis=-1).reshape(-1, 3)

# The space that a tree takes at each vertex, as a part of the most: 0.4 on flat ground, 1 on slopes.
dx, dy = np.gradient(z, 1000 / (n - 1))
slope = np.hypot(dx, dy).ravel()
space = np.clip(0.4 + slope, 0.4, 1)

# Trunks are at least the sum of two radii apart along the ground; the largest radius is 10 m.
samples = geodisk.sample(vertices, faces, radius=10, radius_factor=space, seed=1)

# Taking trees away brings no others closer. Cutting water out of the mesh would: ways around it
# are longer than those across.
dry = samples.points[:, 2] > -20

random = np.random.default_rng(1)
columns = [
    samples.points[dry],
    samples.normals[dry],
    samples.radius[dry, None] / 10 * random.uniform(0.8, 1, (dry.sum(), 1)),
    random.uniform(0, 360, (dry.sum(), 1)),
]
header = "x,y,z,nx,ny,nz,scale,turn"
np.savetxt(folder / "trees.csv", np.hstack(columns), "%.6g", ",", header=header, comments="")

samples.save(folder / "samples.csv")
with open(folder / "terrain.obj", "w") as file:
    np.savetxt(file, vertices, "v %.17g %.17g %.17g")
    np.savetxt(file, faces + 1, "f %d %d %d")
print(f"{dry.sum()} trees of {len(samples)} samples")
