"""Training points: so many on each mesh, with face ids, barycentric weights and labels.

usage: python3 training.py FOLDER
Writes epoch-0.npz, epoch-1.npz, ... for numpy.load, each with other points on the same mesh.
"""

import pathlib
import sys

import geodisk
import numpy as np

folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)

# A torus whose faces have labels, one of four quarters; yours come with your data set.
rings, sides = 96, 48
u, v = np.meshgrid(np.arange(rings), np.arange(sides), indexing="ij")
a, b = 2 * np.pi * u / rings, 2 * np.pi * v / sides
vertices = np.stack([(2 + np.cos(b)) * np.cos(a), (2 + np.cos(b)) * np.sin(a), np.sin(b)], -1)
vertices = vertices.reshape(-1, 3)
at = lambda i, j: i % rings * sides + j % sides
low, right, up, far = at(u, v), at(u + 1, v), at(u, v + 1), at(u + 1, v + 1)
faces = np.stack([low, right, far, low, far, up], -1).reshape(-1, 3)
face_labels = np.arange(len(faces)) * 4 // len(faces)

points_per_mesh = 2048
mesh = geodisk.Mesh(vertices, faces)  # Prepared once for all epochs.

# The distance comes from a count, which is met to 5 %: so ask for 6 % more and keep the first.
distance = geodisk.sample(mesh, count=1.06 * points_per_mesh).min_distance

for epoch in range(3):
    samples = geodisk.sample(
        mesh, min_distance=distance, seed=epoch, stop_count=points_per_mesh
    )
    assert len(samples) == points_per_mesh
    # The weights carry whatever the vertices have to the points; here their positions.
    corners = vertices[faces[samples.face_index]]
    assert np.allclose(np.einsum("nk,nkd->nd", samples.barycentric, corners), samples.points)
    np.savez(
        folder / f"epoch-{epoch}.npz",
        points=samples.points.astype(np.float32),
        normals=samples.normals.astype(np.float32),
        face_index=samples.face_index,
        barycentric=samples.barycentric.astype(np.float32),
        label=face_labels[samples.face_index],
        # Samples come in the order of the darts, so the first n are spread over the whole surface,
        # and each resolution has the points of the coarser ones.
        resolutions=[points_per_mesh // 16, points_per_mesh // 4, points_per_mesh],
    )
print(f"{points_per_mesh} points in each of 3 epochs, at least {distance:.4g} apart")
