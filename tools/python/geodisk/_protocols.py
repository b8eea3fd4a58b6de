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
    str,
    "os.PathLike[str]",
]
