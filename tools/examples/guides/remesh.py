"""Remeshing: a coarse mesh whose vertices are samples of a fine one, joined where their cells meet.

usage: python3 remesh.py FOLDER
Writes coarse.obj.
"""

import heapq
import pathlib
import sys

import geodisk
import numpy as np

folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)

# A torus of 20,000 triangles; yours may be any mesh that is much finer than the new one.
rings, sides = 140, 72
u, v = np.meshgrid(np.arange(rings), np.arange(sides), indexing="ij")
a, b = 2 * np.pi * u / rings, 2 * np.pi * v / sides
vertices = np.stack([(2 + np.cos(b)) * np.cos(a), (2 + np.cos(b)) * np.sin(a), np.sin(b)], -1)
vertices = vertices.reshape(-1, 3)
at = lambda i, j: i % rings * sides + j % sides
low, right, up, far = at(u, v), at(u + 1, v), at(u, v + 1), at(u + 1, v + 1)
faces = np.stack([low, right, far, low, far, up], -1).reshape(-1, 3)

# A large pool leaves few gaps, so that the new triangles are more alike.
seeds = geodisk.sample(vertices, faces, count=300, pool_ratio=200, seed=1)

# The seed that is nearest to each vertex, by ways along edges.
neighbours = [set() for _ in vertices]
for face in faces.tolist():
    for k in range(3):
        neighbours[face[k]] |= {face[k - 1], face[k - 2]}
queue = [
    (float(np.linalg.norm(vertices[corner] - point)), int(corner), seed)
    for seed, (point, face) in enumerate(zip(seeds.points, seeds.face_index))
    for corner in faces[face]
]
heapq.heapify(queue)
cell = np.full(len(vertices), -1)
while queue:
    distance, vertex, seed = heapq.heappop(queue)
    if cell[vertex] < 0:
        cell[vertex] = seed
        for other in neighbours[vertex]:
            if cell[other] < 0:
                step = float(np.linalg.norm(vertices[other] - vertices[vertex]))
                heapq.heappush(queue, (distance + step, other, seed))

# Where three cells meet in a face, their seeds make a triangle.
cells = cell[faces]
meets = (cells[:, 0] != cells[:, 1]) & (cells[:, 1] != cells[:, 2]) & (cells[:, 2] != cells[:, 0])
triangles = cells[meets]

with open(folder / "coarse.obj", "w") as file:
    np.savetxt(file, seeds.points, "v %.9g %.9g %.9g")
    np.savetxt(file, triangles + 1, "f %d %d %d")
print(f"{len(vertices)} vertices became {len(seeds)}, {len(faces)} triangles {len(triangles)}")
