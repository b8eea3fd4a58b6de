"""What meshes of other packages look like to a type checker."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Protocol, Sequence, Union

from numpy.typing import ArrayLike

if TYPE_CHECKING:
    from ._mesh import Mesh


class HasFaces(Protocol):
    """Vertices and faces, as trimesh has them."""

    @property
    def vertices(self) -> Any: ...
    @property
    def faces(self) -> Any: ...


class HasTriangles(Protocol):
    """Vertices and triangles, as legacy meshes of Open3D have them."""

    @property
    def vertices(self) -> Any: ...
    @property
    def triangles(self) -> Any: ...


class HasTensors(Protocol):
    """Tensors by name, as tensor meshes of Open3D have them."""

    @property
    def vertex(self) -> Any: ...
    @property
    def triangle(self) -> Any: ...


class HasCells(Protocol):
    """Points and cells, as meshes of meshio and grids of PyVista have them."""

    @property
    def points(self) -> Any: ...
    @property
    def cells(self) -> Any: ...


class HasPaddedFaces(Protocol):
    """Points and one array of faces with their sizes, as PolyData of PyVista has them."""

    @property
    def points(self) -> Any: ...
    @property
    def faces(self) -> Any: ...


class HasVertexCells(Protocol):
    """Vertices and cells, as vedo has them."""

    @property
    def vertices(self) -> Any: ...
    @property
    def cells(self) -> Any: ...


class HasGraph(Protocol):
    """Meshes placed by a graph, as scenes of trimesh have them."""

    @property
    def geometry(self) -> Any: ...
    @property
    def graph(self) -> Any: ...


class HasPolys(Protocol):
    """Cells by kind, as vtkPolyData has them."""

    def GetPolys(self) -> Any: ...
    def GetStrips(self) -> Any: ...


class HasMatrices(Protocol):
    """Matrices of vertices and faces, as meshes of PyMeshLab have them."""

    def vertex_matrix(self) -> Any: ...
    def face_matrix(self) -> Any: ...


class HasCurrentMesh(Protocol):
    """Several meshes, one of them chosen, as a MeshSet of PyMeshLab has them."""

    def current_mesh(self) -> Any: ...


class HasDataArrays(Protocol):
    """Arrays with intents, as GIFTI images of nibabel have them."""

    @property
    def darrays(self) -> Any: ...


class HasCoordinates(Protocol):
    """Coordinates and faces, as meshes of nilearn have them."""

    @property
    def coordinates(self) -> Any: ...
    @property
    def faces(self) -> Any: ...


class HasLists(Protocol):
    """Vertices and faces of each mesh, as Meshes of PyTorch3D have them."""

    def verts_list(self) -> Any: ...
    def faces_list(self) -> Any: ...


class HasPositions(Protocol):
    """Positions and faces of shape (3, f), as Data of PyG has them."""

    @property
    def pos(self) -> Any: ...
    @property
    def face(self) -> Any: ...


class HasUsdAttributes(Protocol):
    """Attributes of a prim, as meshes of USD (UsdGeom.Mesh) have them."""

    def GetPointsAttr(self) -> Any: ...
    def GetFaceVertexIndicesAttr(self) -> Any: ...


class HasIndices(Protocol):
    """Points and one array of corners, as meshes of Warp have them."""

    @property
    def points(self) -> Any: ...
    @property
    def indices(self) -> Any: ...


#: Triangles, polygons of one size, or of several.
Faces = Union[ArrayLike, Sequence[Sequence[int]]]

#: A mesh that brings its faces, or the path of one.
MeshLike = Union[
    "Mesh",
    HasFaces,
    HasTriangles,
    HasTensors,
    HasCells,
    HasPaddedFaces,
    HasVertexCells,
    HasGraph,
    HasPolys,
    HasMatrices,
    HasCurrentMesh,
    HasDataArrays,
    HasCoordinates,
    HasLists,
    HasPositions,
    HasIndices,
    HasUsdAttributes,
    str,
    "os.PathLike[str]",
]
