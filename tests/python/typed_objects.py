"""What type checkers make of meshes of other packages. Checked by mypy, never run."""

from __future__ import annotations

from typing import Any, Sequence

import numpy as np
from numpy.typing import NDArray

import geodisk


class Vector3dVector: ...


class TriangleMesh:
    """As Open3D's stubs have it: properties with types of their own."""

    @property
    def vertices(self) -> Vector3dVector: ...  # type: ignore[empty-body]
    @vertices.setter
    def vertices(self, value: Vector3dVector) -> None: ...
    @property
    def triangles(self) -> Vector3dVector: ...  # type: ignore[empty-body]
    @triangles.setter
    def triangles(self, value: Vector3dVector) -> None: ...


class TensorMesh:
    @property
    def vertex(self) -> object: ...
    @property
    def triangle(self) -> object: ...


class PolyData:
    """As PyVista has it."""

    @property
    def points(self) -> NDArray[np.float32]: ...  # type: ignore[empty-body]
    @property
    def faces(self) -> NDArray[np.int64]: ...  # type: ignore[empty-body]


class MeshioMesh:
    points: NDArray[np.float64]
    cells: list[object]


class Trimesh:
    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]


class VtkPolyData:
    def GetPolys(self) -> object: ...
    def GetStrips(self) -> object: ...


class PyMeshLabMesh:
    def vertex_matrix(self) -> NDArray[np.float64]: ...  # type: ignore[empty-body]
    def face_matrix(self) -> NDArray[np.int32]: ...  # type: ignore[empty-body]


class Data:
    """As PyG has it."""

    @property
    def pos(self) -> object | None: ...
    @property
    def face(self) -> object | None: ...


def others(vtk: VtkPolyData, pymeshlab: PyMeshLabMesh, pyg: Data) -> list[geodisk.Samples]:
    return geodisk.sample_many([vtk, pymeshlab, pyg], count=100, attributes="all")


def use(
    legacy: TriangleMesh,
    tensors: TensorMesh,
    poly: PolyData,
    mesh: MeshioMesh,
    trimesh: Trimesh,
) -> Sequence[Any]:
    meshes = [geodisk.Mesh(legacy), geodisk.Mesh(tensors), geodisk.Mesh(poly)]
    meshes += [geodisk.Mesh(mesh), geodisk.Mesh(trimesh), geodisk.Mesh(meshes[0].vertices, [[0, 1, 2]])]
    a = geodisk.sample(legacy, count=100)
    b = geodisk.sample(tensors, min_distance=0.1, device=geodisk.devices()[0])
    c = geodisk.sample(poly, count=100, progress=lambda part, samples: None)
    d = geodisk.sample([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], [[0, 1, 2]], count=9)
    many: list[geodisk.Samples] = geodisk.sample_many([trimesh, mesh, "a.stl"], count=100)
    one_sample: geodisk.Sample = a[0]
    chosen: geodisk.Samples = a[a.radius > 0][:5]
    points, faces = geodisk.compat.trimesh.sample_surface_even(trimesh, 100)
    assert points.dtype == np.float64 and faces.dtype == np.int64
    return [a, b, c, d, many, one_sample, chosen]


def coordinates_of_samples(samples: geodisk.Samples) -> tuple[float, NDArray[Any]]:
    return float(samples.points[:, 0].max()), np.asarray(samples)
