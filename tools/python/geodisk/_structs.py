"""The structs, functions and numbers of geodisk/geodisk.h and of geodisk_python.h.

Structs and functions are those that the headers in the library declare.
"""

from __future__ import annotations

import re
from ctypes import (
    Array,
    CDLL,
    CFUNCTYPE,
    POINTER,
    Structure,
    addressof,
    byref,
    c_char,
    c_char_p,
    c_double,
    c_float,
    c_int32,
    c_int64,
    c_size_t,
    c_uint8,
    c_uint32,
    c_uint64,
    c_void_p,
    sizeof,
)
from typing import Any, Iterator

import numpy as np

FLOAT64, FLOAT32, UINT32, UINT16 = range(4)
FACE, BARYCENTRIC, POSITION, NORMAL, RADIUS, PART, CLASS, FEATURE, LEVEL, COVER, ROW = range(11)
METRICS = {"geodesic": 0, "euclidean": 1, "approximate": 2}
AMONG = {"vertices": 0, "sources": 2}
AMONG_POINTS = 1
NO_ELEMENT = 2**64 - 1
#: Orders that geodisk_request.order takes.
ORDERS = {"dart": 0, "progressive": 1, "farthest": 2}

#: Types of C; those of the headers are added.
_TYPES: dict[str, Any] = {
    "char": c_char,
    "double": c_double,
    "float": c_float,
    "int32_t": c_int32,
    "int64_t": c_int64,
    "size_t": c_size_t,
    "uint8_t": c_uint8,
    "uint32_t": c_uint32,
    "uint64_t": c_uint64,
    "void": None,
}
_COMMENT = re.compile(r"/\*.*?\*/|^#.*?$", re.DOTALL | re.MULTILINE)
_NUMBER = re.compile(r"\btypedef (\w+) (\w+);")
_STRUCT = re.compile(r"\bstruct geodisk_(\w+) \{([^{}(,]*)\}")
_FUNCTION = re.compile(r"\bGEODISK_C_API ([\w ]+ \**)(\w+)\(([^;]*)\);")
_NAME = re.compile(r"(\w+)(?:\[(\d+)\])?$")

#: Structs by name: MeshParams is geodisk_mesh_params.
found: dict[str, Any] = {}


class Struct(Structure):
    """A struct, which knows its size if it begins with that, and keeps what its fields point to.

    A pointer may be set to an array, another struct or an object of the library. They live as long as
    this struct, which the thread of a call has, even after Ctrl-C has ended the wait for it.
    """

    def __init__(self, **fields: Any) -> None:
        super().__init__()
        for name, value in fields.items():
            setattr(self, name, value)
        if hasattr(self, "struct_size"):
            self.struct_size = sizeof(type(self))

    def __setattr__(self, name: str, value: Any) -> None:
        address: Any = getattr(value, "_as_parameter_", None)
        if isinstance(value, np.ndarray):
            address = value.ctypes.data
        elif isinstance(value, (Structure, Array)):
            address = addressof(value)
        if address is not None:
            self.__dict__.setdefault("_kept", {})[name] = value
        super().__setattr__(name, value if address is None else address)

    @property
    def _as_parameter_(self) -> Any:
        """What ctypes passes for this struct."""
        return byref(self)

    def items(self) -> Iterator[tuple[str, Any]]:
        """Returns the names and values of the fields but for the size."""
        names = (name for name, *_ in self._fields_)
        return ((name, getattr(self, name)) for name in names if name != "struct_size")


def __getattr__(name: str) -> Any:
    """Returns a struct."""
    if name not in found:
        raise AttributeError(f"there is no struct {name}")
    return found[name]


def _type_of(declaration: str) -> Any:
    """Returns a type, which may have a name. Pointers are addresses, but for text."""
    if "*" in declaration or re.search(r"_fn\b", declaration):
        return c_char_p if re.search(r"\bchar \*[^*]*$", declaration) else c_void_p
    (kind,) = [_TYPES[word] for word in declaration.split() if word in _TYPES]
    return kind


def _fields_of(body: str) -> Iterator[tuple[str, Any]]:
    for declaration in filter(None, map(str.strip, body.split(";"))):
        name = _NAME.search(declaration)
        assert name is not None
        kind = _type_of(declaration)
        yield name[1], kind * int(name[2]) if name[2] else kind


def declare(library: CDLL, headers: str) -> None:
    """Finds the structs in headers, and tells the library's functions their types."""
    text = _COMMENT.sub("", headers)
    for kind, name in _NUMBER.findall(text):
        _TYPES[name] = _TYPES[kind]
    for name, body in _STRUCT.findall(text):
        title = "".join(map(str.capitalize, name.split("_")))
        kind = type(title, (Struct,), {"_fields_": list(_fields_of(body))})
        _TYPES[f"geodisk_{name}"] = found[title] = kind
    for result, name, arguments in _FUNCTION.findall(text):
        function = getattr(library, name)
        function.restype = _type_of(result)
        function.argtypes = [_type_of(one) for one in arguments.split(",") if one != "void"]
    found["PROGRESS_FN"] = CFUNCTYPE(c_int32, c_void_p, POINTER(found["Progress"]))


TAKE_FN = CFUNCTYPE(None, c_void_p, c_size_t)
