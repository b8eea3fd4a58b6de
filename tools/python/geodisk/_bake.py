"""Maps of the nearest sample, as textures."""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _errors as e
from . import _library as c
from . import _structs as s
from ._devices import name_of
from ._existing import points_of
from ._files import bytes_of, complete
from ._inputs import run
from ._mesh import Mesh, created
from ._samples import Samples
from ._searching import search
from ._source import MeshFile, Source, read_file
from ._values import flag, integer, path_of, pixels


@dataclass(frozen=True, eq=False)
class SampleMap:
    """The nearest sample of each texel of a texture. Row 0 is that of v = 1.

    Attributes
    ----------
    sample : ndarray of int32, shape (h, w)
        Number of the nearest sample; -1 where no path leads to one, and where neither a face nor
        padding lies.
    distance : ndarray of float32, shape (h, w)
        How far it is along the surface; infinite without a sample, NaN without face and padding.
    face : ndarray of int32, shape (h, w)
        Triangle that covers the centre of the texel; -1 for none, also in padding.
    error : float
        Distances are at most so far from exact ones on the mesh.
    overlapping : int
        Texels that several triangles cover, of which the lowest counts.
    """

    sample: NDArray[np.int32]
    distance: NDArray[np.float32]
    face: NDArray[np.int32]
    error: float
    overlapping: int

    def save(self, path: str | os.PathLike[str], *, depth: int = 8) -> None:
        """Writes the map to a file, completely or not at all, as the program does.

        Parameters
        ----------
        path : str or path-like
            ``*.npz`` with the arrays `sample`, `distance` and `face`, ``*.npy`` with the distances,
            or ``*.png``, which shows distances from black at samples to white at the largest.
        depth : {8, 16}
            Bits of each channel of ``*.png``.
        """
        path = path_of(path)
        height, width = self.sample.shape
        for name in ["distance", "face"]:
            if getattr(self, name).shape != self.sample.shape:
                raise e.invalid(
                    f"{name} has the shape {getattr(self, name).shape}, and sample {self.sample.shape}"
                )
        arrays = {
            "map_samples": np.ascontiguousarray(self.sample, np.int32),
            "map_distances": np.ascontiguousarray(self.distance, np.float32),
            "map_faces": np.ascontiguousarray(self.face, np.int32),
        }
        bits = str(integer(depth, "depth", 2**31))
        suffix = os.path.splitext(path)[1]
        content = bytes_of(
            suffix,
            lambda name: c.run("save_map", arrays, width=width, height=height, path=name, depth=bits),
        )
        with complete(path) as file:
            file.write(content)

    def __repr__(self) -> str:
        height, width = self.sample.shape
        return f"<geodisk.SampleMap of {width} x {height} texels>"


def bake(
    mesh: str | os.PathLike[str] | Mesh,
    samples: Samples,
    *,
    size: int | tuple[int, int] = 1024,
    padding: int = 0,
    allow_outside: bool = False,
) -> SampleMap:
    """Returns the sample that is nearest to each texel of a texture, along the surface.

    Parameters
    ----------
    mesh : str, path-like or Mesh
        File of the mesh, with texture coordinates, or a mesh that was read from such a file, which is
        read again; its walls hold. Outside of 0 to 1 the coordinates wrap around.
    samples : Samples
        Samples of the mesh, or points of other programs, which are put on the nearest triangle.
    size : int or (width, height)
        Texels, 1 to 16384 along each side.
    padding : int
        Also fill texels so far away from islands of the texture, 0 to 16384, from the nearest texel
        that has a face.
    allow_outside : bool
        As for :class:`Mesh`, for the path of a file.

    Returns
    -------
    SampleMap

    Raises
    ------
    InvalidArgument
        For a file without texture coordinates or that changed since the mesh was read, and samples
        that are not on the mesh.
    OSError
        For a file that does not exist or cannot be read.
    TypeError, OutOfMemory, NoDevice, KeyboardInterrupt
        As :func:`sample` and :func:`verify` do.

    Examples
    --------
    >>> import geodisk, os, tempfile
    >>> path = os.path.join(tempfile.mkdtemp(), "square.obj")
    >>> with open(path, "w") as file:
    ...     _ = file.write("v 0 0 0\\nv 1 0 0\\nv 1 1 0\\nv 0 1 0\\n")
    ...     _ = file.write("vt 0 0\\nvt 1 0\\nvt 1 1\\nvt 0 1\\nf 1/1 2/2 3/3 4/4\\n")
    >>> corners = geodisk.Samples([[0, 0, 0], [1, 1, 0]])
    >>> geodisk.bake(path, corners, size=3).sample.tolist()
    [[0, 1, 1], [0, 0, 1], [0, 0, 0]]
    """
    if not isinstance(samples, Samples):
        raise TypeError(f"samples are a geodisk.Samples, not {type(samples).__name__}")
    sides = size if isinstance(size, (tuple, list, np.ndarray)) else (size, size)
    width, height = pixels(sides, 1)
    padding = integer(padding, "padding", 16384)
    source, on, path = _texture_of(mesh, flag(allow_outside, "allow_outside"))
    points = points_of(on, samples, "samples", is_needed=True)
    params = s.CellParams(samples=points, sample_count=len(points))
    nearest = search("nearest", "geodisk_nearest_create", on, params, name_of(None), False)
    arrays = {"source": source.handle, "nearest": nearest}
    name = os.fsencode(path).decode("utf-8", "replace")
    made = run("bake", arrays=arrays, width=width, height=height, padding=padding, path=name)

    def view(index: int, dtype: Any) -> NDArray[Any]:
        return np.frombuffer(made[index], dtype).reshape(height, width).copy()

    return SampleMap(
        view(0, np.int32),
        view(1, np.float32),
        view(2, np.int32),
        c.ask("geodisk_nearest_error", nearest),
        int.from_bytes(made[3], sys.byteorder),
    )


def _texture_of(
    mesh: str | os.PathLike[str] | Mesh, allow_outside: bool
) -> tuple[Source, c.Handle, str]:
    """Returns a mesh as it is in its file, with texture coordinates, the library's mesh and the path."""
    if isinstance(mesh, (str, os.PathLike)):
        file = MeshFile(path_of(mesh, "mesh"), allow_outside=allow_outside)
    elif not isinstance(mesh, Mesh) or mesh._file is None:
        raise TypeError(
            "bake needs the path of a mesh file, which has texture coordinates, or a geodisk.Mesh that "
            "was read from one"
        )
    else:
        file = mesh._file
    try:
        source = read_file(file, has_uvs=True)
    except e.MeshRejected as error:
        raise e.invalid(str(error)) from None
    if not isinstance(mesh, Mesh):
        return source, created(source.surface), file.path
    surface = mesh._surface  # Which walls may have cut since.
    places = surface.coordinates()[: surface.own_vertex_count()]
    if not (
        np.array_equal(source.surface.own_corners(), surface.own_corners())
        and np.array_equal(source.surface.vertices, places)
    ):
        raise e.invalid(f"{file.path}: changed since the mesh was read")
    if surface.walls:
        source.leave_out(surface.repeats_vertex())
    return source, mesh._handle, file.path
