"""Arrays of a caller's as the library takes them."""

from __future__ import annotations

import zlib
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors as e


def unreadable(name: str, error: Exception) -> TypeError:
    """Returns the error for values that numpy does not read, which failed with `error`."""
    if isinstance(error, ValueError) and "inhomogeneous" in str(error):
        return TypeError(f"{name} has to be an array, with rows of one length")
    if "BFloat16" in str(error):  # Of torch.
        return TypeError(f"{name} is of bfloat16, which numpy does not have; give it as .float()")
    return TypeError(f"{name} cannot be read as an array: {str(error) or type(error).__name__}")


#: Methods that lead from arrays of other packages to numpy: of torch; torch and Open3D; CuPy; all but CuPy.
_TO_HOST = ("detach", "cpu", "get", "numpy")


def on_host(values: Any) -> Any:
    """Returns an array of another package as one of numpy, without gradients, from any device.

    Returns anything else as it is.
    """
    if isinstance(values, np.ndarray) or not hasattr(values, "__dlpack__"):
        return values
    for step in _TO_HOST:
        if hasattr(values, step):
            values = getattr(values, step)()
    if hasattr(values, "__array__"):
        return np.asarray(values)
    from_dlpack: Any = np.from_dlpack
    is_on_host = values.__dlpack_device__()[0] == 1  # kDLCPU.
    return from_dlpack(values) if is_on_host else from_dlpack(values, device="cpu")


def array_of(values: ArrayLike, name: str) -> NDArray[Any]:
    """Returns an array. Raises TypeError for rows of different lengths and masked values, and with
    its cause for an object that gives no array."""
    try:
        array = np.asarray(on_host(values))
    except MemoryError:
        raise
    except Exception as error:  # Of numpy, or of the object.
        raise unreadable(name, error) from error
    if isinstance(values, np.ma.MaskedArray) and np.any(values.mask):
        raise TypeError(f"{name} has masked values; fill them, such as by values.filled(0)")
    return array


def real(array: ArrayLike, name: str) -> NDArray[Any]:
    """As float64, or float32 where it is that."""
    array = array_of(array, name)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name} has to be of real numbers, not of {array.dtype}")
    if array.dtype not in (np.float64, np.float32):
        array = array.astype(np.float64)
    return array


def rows(array: NDArray[Any]) -> NDArray[Any]:
    """The same, or a copy of it unless the numbers of a row lie side by side and rows follow."""
    fine = array.ndim == 2 and (array.shape[1] < 2 or array.strides[1] == array.itemsize)
    fine = fine and array.strides[0] >= array.shape[1] * array.itemsize
    fine = fine and array.strides[0] % array.itemsize == 0 and array.flags.aligned
    fine = fine and array.dtype.isnative
    return array if fine else np.ascontiguousarray(array, dtype=array.dtype.newbyteorder("="))


def indices(
    values: ArrayLike, name: str, error: type[e.Error] = e.InvalidArgument
) -> NDArray[Any]:
    """As uint32, or uint16 where it is that. Other numbers raise `error`."""
    array = array_of(values, name)
    if array.size == 0 and array.dtype.kind == "f":  # As numpy has [].
        array = array.astype(np.uint32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} have to be of integers, not of {array.dtype}")
    if array.dtype in (np.uint32, np.uint16):
        return np.ascontiguousarray(array, dtype=array.dtype.newbyteorder("="))
    if array.dtype == np.int32 and array.dtype.isnative and array.flags.c_contiguous:
        view = array.view(np.uint32)
        if array.size == 0 or array.min() >= 0:
            return view
    bad = np.atleast_1d((array < 0) | (array > 2**32 - 1)) if array.size else np.zeros(0, bool)
    if bad.any():
        array = np.atleast_1d(array)
        place = np.argwhere(bad)[0]
        raise error(
            f"{name}[{', '.join(map(str, place))}] is {array[tuple(place)]}, which is no index",
            "mesh_rejected" if error is e.MeshRejected else "invalid_argument",
            int(place[0]),
        )
    return np.ascontiguousarray(array, dtype=np.uint32)


def checksum(array: NDArray[Any]) -> str:
    """Returns eight digits that practically differ for other values."""
    return f"{zlib.crc32(array.astype(array.dtype.newbyteorder('<')).tobytes()):08x}"


def mask_digest(mask: NDArray[np.uint8]) -> str:
    """Returns what headers tell of a mask, as the library takes it."""
    return checksum(np.packbits(mask))
