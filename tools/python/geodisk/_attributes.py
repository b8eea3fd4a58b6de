"""Attributes of meshes, and their values at samples."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e
from ._arrays import array_of


@dataclass(frozen=True, eq=False)
class Attribute:
    """An attribute of a mesh file."""

    values: NDArray[np.float64]  #: Shape (m,) or (m, k).
    corners: NDArray[np.uint32] | None  #: The value of each corner; None if faces have the values.
    of_vertices: bool  #: True if the values are those of the vertices, in order.
    is_whole: bool  #: True for integers, which are not interpolated.
    is_light: bool  #: True for amounts of light, which sRGB encodes once they are interpolated.
    polygons: NDArray[np.uint32] | None  #: The face of each triangle, where the numbers differ.

    def array(self) -> NDArray[np.float64]:
        """Returns the values of vertices, of the corners of triangles, or of triangles."""
        values = _encoded(self.values) if self.is_light else self.values
        if self.of_vertices:
            return values
        if self.corners is not None:
            return values[self.corners]
        return values if self.polygons is None else values[self.polygons]

    def at(self, faces: NDArray[Any], weights: NDArray[Any]) -> NDArray[Any]:
        """Returns the values at samples: int32 for integers that fit, else float64."""
        if self.corners is None:
            found = self.array()[faces]
        else:
            found = interpolated(self.values[self.corners[faces]], weights, self.is_whole)
            found = _encoded(found) if self.is_light else found
        fits = self.is_whole and bool((np.abs(found) < 2**31).all())
        return np.asarray(found, np.int32 if fits else np.float64)


def _encoded(light: NDArray[np.float64]) -> NDArray[np.float64]:
    """Returns colours as sRGB encodes them, of amounts of light."""
    bright = 1 + 1.055 * (np.maximum(light, 0.0031308) ** (1 / 2.4) - 1)
    found = np.where(light <= 0.0031308, 12.92 * light, bright)
    found[..., 3:] = light[..., 3:]
    return found


def interpolated(
    corners: NDArray[Any], weights: NDArray[Any], nearest: bool
) -> NDArray[Any]:
    """Returns values at samples, of those that the corners of their triangles have."""
    if nearest:
        found: NDArray[Any] = corners[np.arange(len(corners)), weights.argmax(axis=1)]
        return found
    shares = weights / weights.sum(axis=1, keepdims=True)
    shares = shares.reshape(shares.shape + (1,) * (corners.ndim - 2))
    mean: NDArray[Any] = (shares * corners).sum(axis=1)
    return np.clip(mean, corners.min(axis=1), corners.max(axis=1))


def values_of(values: ArrayLike, count: int, what: str) -> NDArray[Any]:
    """Returns values as an array with one for each of `count` vertices or faces."""
    array = array_of(values, "values")
    if array.dtype.kind not in "biufSU":
        raise TypeError(f"values have to be of numbers or text, not of {array.dtype}")
    if array.ndim == 0 or len(array) != count:
        raise e.invalid(f"values have the shape {array.shape}, but the mesh has {count} {what}")
    return array


def check_finite(corners: NDArray[Any], faces: NDArray[Any]) -> None:
    """Raises if a value at a sample is not finite."""
    if corners.dtype.kind == "f" and not np.isfinite(corners).all():
        row = np.argwhere(~np.isfinite(corners))[0][0]
        raise e.invalid(f"a value of triangle {faces[row]} is not finite, where sample {row} lies")


#: Names of the columns of attributes of several numbers, by name and width.
_COMPONENTS = {
    ("uv", 2): ("u", "v"),
    ("frames", 4): ("qx", "qy", "qz", "qw"),
}

_COLOUR = re.compile(r"(face_|vertex_|)color(\d*)")


def _components(name: str, width: int) -> tuple[str, ...] | None:
    """Returns the columns of an attribute of several numbers that has names for them."""
    if width in (3, 4) and (match := _COLOUR.fullmatch(name)):
        parts = ("red", "green", "blue", "alpha")[:width]
        return tuple(f"{match[1]}{part}{match[2]}" for part in parts)
    return _COMPONENTS.get((name, width))


def is_called(name: str, array: NDArray[Any], names: Sequence[str]) -> bool:
    """Returns True if an attribute or one of its components is among names."""
    width = array.shape[-1] if array.ndim > 1 else 1
    return any(one in names for one in (name, *(_components(name, width) or ())))


def number_named(attributes: dict[str, Attribute], name: str, what: str) -> NDArray[np.float64]:
    """Returns an attribute of one number, a component of one, or the luminance of colours."""
    for key, attribute in attributes.items():
        values = attribute.array()
        width = attribute.values.shape[1] if attribute.values.ndim == 2 else 1
        parts = _components(key, width) or ()
        if name in parts:
            return np.asarray(values[..., parts.index(name)])
        if name == key and width == 1:
            return values
        if name == key and parts[:1] and _COLOUR.fullmatch(key):
            return np.asarray(values[..., :3] @ [77 / 256, 150 / 256, 29 / 256])
    raise e.invalid(
        f"{what} is {name!r}, but the mesh was read with "
        + (f"the attributes {', '.join(attributes)}" if attributes else "no attributes")
        + f"; give an array, or read it as geodisk.Mesh(path, attributes=[{name!r}])"
    )


def is_colour(name: str, array: NDArray[Any]) -> bool:
    """Returns True for an attribute of colours from 0 to 1, or of bytes."""
    is_wide = array.ndim == 2 and array.shape[1] in (3, 4) and array.dtype.kind in "fui"
    return is_wide and _COLOUR.fullmatch(name) is not None


def with_bytes(attributes: dict[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
    """Returns attributes with colours as integers from 0 to 255, as viewers expect them in PLY."""
    found = dict(attributes)
    for name, array in attributes.items():
        if not is_colour(name, array):
            continue
        if array.dtype.kind == "f" and not np.isfinite(array).all():
            raise e.invalid(f"attributes[{name!r}] has a colour that is not finite")
        steps = np.floor(255 * np.clip(array, 0, 1) + 0.5) if array.dtype.kind == "f" else array
        found[name] = np.clip(steps, 0, 255).astype(np.uint8)
    return found


def columns_of_attributes(attributes: dict[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
    """Returns attributes as columns of one number each."""
    columns: dict[str, NDArray[Any]] = {}
    for name, array in attributes.items():
        width = array.shape[1] if array.ndim == 2 else 1
        own = tuple(f"{name}_{i}" for i in range(width)) if array.ndim == 2 else (name,)
        # Files have no other characters in names.
        own = tuple(re.sub(r"[^\w.-]", "_", one, flags=re.ASCII) for one in own)
        own = _components(name, width) or own
        if twice := columns.keys() & set(own):
            raise e.invalid(f"two attributes have the column {twice.pop()!r}; rename one of them")
        columns.update(zip(own, array.reshape(len(array), width).T))
    return columns


def attributes_of_columns(columns: dict[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
    """Returns the attributes that columns of one number each were made of."""
    left = dict(columns)
    found: dict[str, NDArray[Any]] = {}
    colours = [re.sub(r"red(?=\d*$)", "color", name) for name in columns]
    names = [name for name in colours if _COLOUR.fullmatch(name)]
    tables = [(name, width) for name in names for width in (4, 3)] + list(_COMPONENTS)
    for name, width in tables:
        parts = _components(name, width)
        if parts is not None and all(part in left for part in parts):
            own = [left.pop(part) for part in parts]
            is_bytes = _COLOUR.fullmatch(name) and all(x.dtype == np.uint8 for x in own)
            table = np.stack(own, axis=1).astype(np.float64)
            found[name] = table / 255 if is_bytes else table
    for name, column in left.items():
        found[name] = np.ascontiguousarray(column.astype(column.dtype.newbyteorder("=")))
    return {name: found[name] for name in sorted(found, key=lambda name: _place(name, columns))}


def _place(name: str, columns: dict[str, NDArray[Any]]) -> int:
    """Returns where an attribute begins among columns."""
    parts = (_components(name, width) for width in (2, 3, 4))
    first = next((part[0] for part in parts if part), name)
    return list(columns).index(name if name in columns else first)
