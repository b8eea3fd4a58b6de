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
from ._background import interruptible
from ._devices import name_of
from ._existing import points_of
from ._inputs import run
from ._mesh import created, surface_from
from ._samples import Samples
from ._searching import search
from ._source import read_file
from ._values import flag, path_of, pixels


@dataclass(frozen=True, eq=False)
class SampleMap:
    """The nearest sample of each texel of a texture. Row 0 is that of v = 1.

    Attributes
    ----------
    sample : ndarray of int32, shape (h, w)
        Number of the nearest sample; -1 where no face lies, and where no path leads to one.
    distance : ndarray of float32, shape (h, w)
        How far it is along the surface; NaN where no face lies, infinite without a sample.
    face : ndarray of int32, shape (h, w)
        Triangle that covers the centre of the texel; -1 for none.
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

    def __repr__(self) -> str:
        height, width = self.sample.shape
        return f"<geodisk.SampleMap of {width} x {height} texels>"


def bake(
    mesh: str | os.PathLike[str],
    samples: Samples,
    *,
    size: int | tuple[int, int] = 1024,
    allow_outside: bool = False,
) -> SampleMap:
    """Returns the sample that is nearest to each texel of a texture, along the surface.

    Parameters
    ----------
    mesh : str or path-like
        File of the mesh, with texture coordinates. Outside of 0 to 1 they wrap around.
    samples : Samples
        Samples of the mesh, or points of other programs, which are put on the nearest triangle.
    size : int or (width, height)
        Texels, 1 to 16384 along each side.
    allow_outside : bool
        As for :class:`Mesh`.

    Returns
    -------
    SampleMap

    Raises
    ------
    InvalidArgument
        For a file without texture coordinates, and samples that are not on the mesh.
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
    if not isinstance(mesh, (str, os.PathLike)):
        raise TypeError("bake needs the path of a mesh file, which has texture coordinates")
    if not isinstance(samples, Samples):
        raise TypeError(f"samples are a geodisk.Samples, not {type(samples).__name__}")
    width, height = pixels(size if isinstance(size, (tuple, list, np.ndarray)) else (size, size))
    path = path_of(mesh, "mesh")
    allow_outside = flag(allow_outside, "allow_outside")
    try:
        source = interruptible(
            lambda stop: read_file(path, stop, allow_outside=allow_outside, has_uvs=True)
        )
    except (e.MeshRejected, OSError) as error:
        raise e.invalid(str(error)) from None
    on = created(surface_from(source, source.vertices, False))
    points = points_of(on, samples, "samples", is_needed=True)
    params = s.CellParams(samples=points.ctypes.data, sample_count=len(points))
    nearest = search("nearest", "geodisk_nearest_create", on, params, name_of(None), False)
    arrays = {"source": source.handle, "nearest": nearest}
    name = os.fsencode(path).decode("utf-8", "replace")
    made = run("bake", arrays=arrays, width=width, height=height, path=name)

    def view(index: int, dtype: Any) -> NDArray[Any]:
        return np.frombuffer(made[index], dtype).reshape(height, width).copy()

    return SampleMap(
        view(0, np.int32),
        view(1, np.float32),
        view(2, np.int32),
        c.nearest_error(nearest.value),
        int.from_bytes(made[3], sys.byteorder),
    )
