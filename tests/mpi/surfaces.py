"""Surfaces as binary PLY files of triangles."""

import math
import struct


def write_ply(path, vertices, faces, order="<", real="d", of_vertices=None, of_faces=None):
    """A binary PLY file; faces of any size. Properties of vertices and faces by their names, in float
    and in double, stand before and behind what all have."""
    of_vertices, of_faces = of_vertices or {}, of_faces or {}
    name = {"f": "float", "d": "double"}[real]
    form = {"<": "binary_little_endian", ">": "binary_big_endian"}[order]
    with open(path, "wb") as file:
        file.write(f"ply\nformat {form} 1.0\nelement vertex {len(vertices)}\n".encode())
        file.write("".join(f"property float {one}\n" for one in of_vertices).encode())
        file.write("".join(f"property {name} {axis}\n" for axis in "xyz").encode())
        file.write(f"element face {len(faces)}\n".encode())
        file.write(b"property list uchar int vertex_indices\n")
        file.write("".join(f"property double {one}\n" for one in of_faces).encode())
        file.write(b"end_header\n")
        for i, vertex in enumerate(vertices):
            more = [values[i] for values in of_vertices.values()]
            file.write(struct.pack(f"{order}{len(more)}f3{real}", *more, *vertex))
        for i, face in enumerate(faces):
            more = [values[i] for values in of_faces.values()]
            file.write(struct.pack(f"{order}B{len(face)}i{len(more)}d", len(face), *face, *more))


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
