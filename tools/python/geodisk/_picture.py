"""Pictures of samples."""

from __future__ import annotations

import os
from typing import Sequence

from numpy.typing import ArrayLike

from . import _errors as e
from ._devices import DeviceLike, name_of
from ._files import complete
from ._inputs import surface_of, write_subject
from ._program import folder, run
from ._protocols import Faces, MeshLike
from ._samples import Samples


class Picture:
    """A picture as PNG, which notebooks show.

    Attributes
    ----------
    png : bytes
        The file. ``matplotlib.pyplot.imread(io.BytesIO(picture.png))`` is an array.
    """

    def __init__(self, png: bytes) -> None:
        self.png = png

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        return int.from_bytes(self.png[16:20], "big"), int.from_bytes(self.png[20:24], "big")

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes it to a file, ``*.png``, whole or not at all."""
        path = os.fspath(path)
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
        On a mesh of up to three dimensions, or in a box.
    vertices, faces, weld, keep_seams
        Their mesh, as :func:`sample` takes it, where it is not the one that they were made on:
        for samples that were read from a file.
    size : (int, int)
        Width and height in pixels.
    style : {"auto", "disks", "points", "voronoi", "distance", "density"}
        Geodesic disks, exact in each pixel; or points, cells, how far the nearest sample is, or how
        dense they are. "auto" draws disks, or points where disks would be too small to tell apart.
    view : str, (float, float), or several of them
        ``"front"``, ``"back"``, ``"left"``, ``"right"``, ``"top"``, ``"bottom"``, azimuth and
        elevation in degrees, or ``"auto"`` for where most is seen from. Several make a sheet.
    up : {"x", "y", "z"}, optional
        The axis that points up. Guessed from what the surface stands on unless given.
    background : str
        ``"white"``, ``"black"``, ``"transparent"`` or ``"RRGGBB"``.
    cut : bool
        Of a box of three dimensions, cut away the eighth nearest to the eye.
    legend : bool
        Add a legend below each view: samples, distance, a scale bar in the unit of the vertices,
        and a colour bar where ``style`` is "distance" or "density".
    min_distance : float, optional
        For disks of half of it, in the unit of the vertices, instead of the samples' radii.
    device : Device, int or str, optional
        As :func:`sample` takes it.

    Returns
    -------
    Picture
        Notebooks show it; ``save("a.png")`` writes it to a file.

    Raises
    ------
    InvalidArgument
        For values out of range, and samples that do not lie on this mesh.
    MeshRejected, TypeError, NoDevice, NoProgram, KeyboardInterrupt
        As :func:`sample` and :func:`verify` do.

    Examples
    --------
    >>> import geodisk
    >>> samples = geodisk.sample_box([1, 1], min_distance=0.1)
    >>> geodisk.render(samples, size=(320, 240))
    <geodisk.Picture of 320 x 240 pixels>
    """
    surface = surface_of(samples, vertices, faces, None, weld, keep_seams)
    options = ["--size", "x".join(map(str, size)), "--style", style, "--background", background]
    for one in [view] if isinstance(view, (str, tuple)) else view:
        name = one if isinstance(one, str) else ",".join(repr(float(angle)) for angle in one)
        options.append(f"--view={name}")
    if up is not None:
        options += ["--up", up]
    if cut:
        options.append("--cut")
    if legend:
        options.append("--legend")
    if min_distance is not None:
        options += ["--min-distance", repr(float(min_distance))]
    if name_of(device):
        options += ["--device", name_of(device)]
    with folder() as place:
        files = write_subject(place, samples, surface)
        run(place, ["render", *files, *options, "--output", "picture.png"])
        return Picture((place / "picture.png").read_bytes())
