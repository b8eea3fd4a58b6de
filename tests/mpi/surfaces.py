"""Surfaces as binary PLY files of triangles."""

import math
import struct


def write_ply(path, vertices, faces, order="<", real="d"):
    """A binary PLY file; faces of any size."""
    name = {"f": "float", "d": "double"}[real]
    form = {"<": "binary_little_endian", ">": "binary_big_endian"}[order]
    with open(path, "wb") as file:
        file.write(f"ply\nformat {form} 1.0\nelement vertex {len(vertices)}\n".encode())
        file.write("".join(f"property {name} {axis}\n" for axis in "xyz").encode())
        file.write(f"element face {len(faces)}\n".encode())
        file.write(b"property list uchar int vertex_indices\nend_header\n")
        for vertex in vertices:
            file.write(struct.pack(f"{order}3{real}", *vertex))
        for face in faces:
            file.write(struct.pack(f"{order}B{len(face)}i", len(face), *face))


def grid(columns, rows, place=lambda u, v: (u, v, 0.3 * math.sin(3 * u) * math.cos(2 * v))):
    """A sheet with a border."""
    vertices = [place(i / columns, j / rows) for i in range(columns + 1) for j in range(rows + 1)]
    faces = []
    for i in range(columns):
        for j in range(rows):
            at = i * (rows + 1) + j
            faces += [(at, at + rows + 1, at + rows + 2), (at, at + rows + 2, at + 1)]
    return vertices, faces


def torus(columns, rows):
    """A closed surface."""
    def place(i, j):
        a, b = 2 * math.pi * i / columns, 2 * math.pi * j / rows
        r = 0.4 * (1 + 0.2 * math.sin(5 * a) * math.cos(3 * b))
        return ((1 + r * math.cos(b)) * math.cos(a), (1 + r * math.cos(b)) * math.sin(a),
                r * math.sin(b))
    vertices = [place(i, j) for i in range(columns) for j in range(rows)]
    number = lambda i, j: i % columns * rows + j % rows
    faces = []
    for i in range(columns):
        for j in range(rows):
            a, b, c, d = number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)
            faces += [(a, b, c), (a, c, d)]
    return vertices, faces
