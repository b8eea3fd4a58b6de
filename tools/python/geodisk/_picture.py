"""Pictures of samples."""

from __future__ import annotations

import os
import reprlib
from numbers import Real
from typing import Any, Sequence

from numpy.typing import ArrayLike

from . import _errors as e
from ._devices import DeviceLike, name_of, opening
from ._files import complete
from ._inputs import mesh_under, option, run
from ._protocols import Faces, MeshLike
from ._samples import Samples
from ._values import flag, listed, number, path_of, pixels, text


class Picture:
    """A PNG picture, which notebooks show.

    Attributes
    ----------
    png : bytes
        The file. ``matplotlib.pyplot.imread(io.BytesIO(picture.png))`` returns an array.
    """

    def __init__(self, png: bytes) -> None:
        self.png = png

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        return int.from_bytes(self.png[16:20], "big"), int.from_bytes(self.png[20:24], "big")

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes it to a file, ``*.png``, completely or not at all."""
        path = path_of(path)
        if os.path.splitext(path)[1].lower() != ".png":
            raise e.invalid(f"{path}: pictures are saved as *.png")
        with complete(path) as file:
            file.write(self.png)

    def _repr_png_(self) -> bytes:
        return self.png

    def __repr__(self) -> str:
        return f"<geodisk.Picture of {self.size[0]} x {self.size[1]} pixels>"


def render(
    samples: Samples,
    vertices: ArrayLike | MeshLike | None = None,
    faces: Faces | None = None,
    *,
    size: tuple[int, int] = (960, 540),
    style: str = "auto",
    view: str | tuple[float, float] | Sequence[str | tuple[float, float]] = "auto",
    up: str | None = None,
    background: str = "white",
    cut: bool = False,
    legend: bool = False,
    min_distance: float | None = None,
    weld: bool | float = False,
    keep_seams: bool = False,
    device: DeviceLike | None = None,
) -> Picture:
    """Draws the surface, or a box of two or three dimensions, with the disk of each sample.

    Parameters
    ----------
    samples : Samples
        Samples on a mesh of up to three dimensions, or in a box.
    vertices, faces, weld, keep_seams
        Mesh of the samples, as for :func:`sample`. Needed for samples that were read from a file.
    size : (int, int)
        Width and height in pixels, 16 to 16384 each.
    style : {"auto", "disks", "points", "voronoi", "distance", "density"}
        Geodesic disks, exact in each pixel; or points, Voronoi cells, the distance to the nearest
        sample, or the density. "auto" draws disks, or points if disks would be too small.
    view : str, (float, float), or several of them
        ``"front"``, ``"back"``, ``"left"``, ``"right"``, ``"top"``, ``"bottom"``, azimuth and
        elevation in degrees, or ``"auto"`` for the view that shows most. Give several for several.
    up : {"x", "y", "z"}, optional
        Axis that points up. By default it is guessed from the surface.
    background : str
        ``"white"``, ``"black"``, ``"transparent"`` or ``"RRGGBB"``.
    cut : bool
        Cut the nearest eighth out of a box of three dimensions.
    legend : bool
        Add a legend below each view: samples, distance, a scale bar in the unit of the vertices,
        and a colour bar if ``style`` is "distance" or "density".
    min_distance : float, optional
        Draw disks with half of this as radius, in the unit of the vertices, instead of the samples'
        radii.
    device : Device, int or str, optional
        Device, as for :func:`sample`.

    Returns
    -------
    Picture
        Notebooks show it; ``save("a.png")`` writes it to a file.

    Raises
    ------
    InvalidArgument
        For values out of range, and samples that are not on this mesh.
    MeshRejected, TypeError, NoDevice, KeyboardInterrupt
        As :func:`sample` and :func:`verify` do.

    Examples
    --------
    >>> import geodisk
    >>> samples = geodisk.sample_box([1, 1], min_distance=0.1)
    >>> geodisk.render(samples, size=(320, 240))
    <geodisk.Picture of 320 x 240 pixels>
    """
    mesh = mesh_under(samples, vertices, faces, None, weld, keep_seams)
    width, height = pixels(size, 16)
    options: dict[str, Any] = {
        "size": f"{width}x{height}",
        "style": text(style, "style"),
        "background": text(background, "background"),
        "up": "" if up is None else text(up, "up"),
        "views": _views(view),
        "cut": flag(cut, "cut"),
        "legend": flag(legend, "legend"),
        "min_distance": option(min_distance, "min_distance"),
        "device": name_of(device),
    }
    with opening(name_of(device)):
        (png,) = run("render", samples, None if mesh is None else mesh._handle, **options)
    return Picture(png)


def _views(view: Any) -> list[str]:
    """Returns the names or angles of one or several views."""
    several = listed(view)
    if several is None or (len(several) == 2 and all(isinstance(x, Real) for x in several)):
        several = [view]
    views = []
    for one in several:
        angles = one if isinstance(one, str) else listed(one)
        if angles is None or (angles is not one and len(angles) != 2):
            raise TypeError(f"view is {reprlib.repr(one)}, neither a name nor azimuth and elevation")
        if not isinstance(angles, str):
            angles = ",".join(repr(number(angle, "view")) for angle in angles)
        views.append(text(angles, "view"))
    return views
