"""Meshes for the tests."""

import numpy as np


def torus(rings=40, sides=20):
    """A closed surface of 2 * rings * sides faces."""
    u, v = np.meshgrid(np.arange(rings), np.arange(sides), indexing="ij")
    a, b = 2 * np.pi * u / rings, 2 * np.pi * v / sides
    points = np.stack(
        [(2 + np.cos(b)) * np.cos(a), (2 + np.cos(b)) * np.sin(a), np.sin(b)], axis=-1
    ).reshape(-1, 3)
    at = lambda i, j: (i % rings) * sides + j % sides
    low, right, up, far = at(u, v), at(u + 1, v), at(u, v + 1), at(u + 1, v + 1)
    faces = np.stack([low, right, far, low, far, up], axis=-1).reshape(-1, 3)
    return points, faces


VERTICES, FACES = torus()
LENGTHS = np.linalg.norm(VERTICES[np.roll(FACES, -1, axis=1)] - VERTICES[FACES], axis=-1)
SOUP = VERTICES[FACES].reshape(-1, 3), np.arange(3 * len(FACES)).reshape(-1, 3)
TETRAHEDRON = (
    np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], float),
    np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]),
)


def same(a, b):
    return np.array_equal(a.face_index, b.face_index) and np.array_equal(
        a.barycentric, b.barycentric
    )
