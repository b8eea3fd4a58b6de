"""Samples as objects of other packages, which are imported only for that."""

from __future__ import annotations

from typing import Any, Callable

import numpy as np
from numpy.typing import NDArray

from . import _errors as e
from ._attributes import with_bytes
from ._values import choice

Arrays = dict[str, NDArray[Any]]


def converted(arrays: Arrays, kind: str) -> Any:
    """Returns arrays of samples by name as an object of a kind of CONVERSIONS."""
    convert = CONVERSIONS[choice(kind, "kind", CONVERSIONS)]
    try:
        return convert(arrays)
    except ModuleNotFoundError as error:
        if error.name != kind:
            raise
        raise ImportError(f"to({kind!r}) needs {kind} (pip install {kind})") from None


def _copied(arrays: Arrays) -> Arrays:
    """Returns copies with signed integers, as other packages take them as indices."""
    return {
        name: array.astype(np.int64 if array.dtype.kind == "u" else array.dtype, order="C")
        for name, array in arrays.items()
    }


def _torch(arrays: Arrays) -> Any:
    import torch

    return {name: torch.from_numpy(array) for name, array in _copied(arrays).items()}


def _in_space(arrays: Arrays) -> tuple[NDArray[np.float64], Arrays]:
    """Returns points with three coordinates, 0 where they have fewer, and the other arrays."""
    others = _copied(arrays)
    points = others.pop("points", None)
    if points is None:
        raise e.invalid("samples on a mesh of edge lengths have no points; give to('numpy')")
    if points.shape[1] > 3:
        raise e.invalid(f"points have {points.shape[1]} coordinates, not 3; give to('numpy')")
    return np.pad(points, [(0, 0), (0, 3 - points.shape[1])]), others


def _pyvista(arrays: Arrays) -> Any:
    import pyvista

    points, others = _in_space(arrays)
    if len(points) == 0:  # It takes no empty arrays.
        return pyvista.PolyData()
    cloud = pyvista.PolyData(points)
    for name, array in with_bytes(others).items():
        cloud.point_data["Normals" if name == "normals" else name] = array
    if "normals" in others:
        cloud.point_data.active_normals_name = "Normals"
    cloud.point_data.active_scalars_name = "color" if "color" in others else None
    return cloud


def _trimesh(arrays: Arrays) -> Any:
    import trimesh

    points, others = _in_space(arrays)
    others = with_bytes(others)
    colours = others.pop("color", None)
    return trimesh.PointCloud(points, colors=colours, metadata=others)


def _open3d(arrays: Arrays) -> Any:
    import open3d

    points, others = _in_space(arrays)
    if "color" in others:
        others["colors"] = others.pop("color")[:, :3].copy()
    cloud = open3d.t.geometry.PointCloud()
    for name, array in {"positions": points, **others}.items():
        cloud.point[name] = open3d.core.Tensor(array)
    return cloud


#: Kinds of objects that samples become.
CONVERSIONS: dict[str, Callable[[Arrays], Any]] = {
    "numpy": dict,
    "torch": _torch,
    "pyvista": _pyvista,
    "trimesh": _trimesh,
    "open3d": _open3d,
    "dlpack": _copied,
}
