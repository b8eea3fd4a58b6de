"""The structs of the package have the fields that the headers of C give them."""

import ctypes
import gc
import os
import re
import subprocess
import weakref

import numpy as np
import pytest

from geodisk import _library as c
from geodisk import _structs
from geodisk._existing import POINT

#: Structs of geodisk.h that the package cannot read and does not use.
UNUSED = "geodisk_placed_record geodisk_sample_record geodisk_vulkan_device".split()


def mirrored():
    """Returns the structs of the package by their names in C."""
    return {
        "geodisk" + re.sub("([A-Z])", r"_\1", name).lower(): struct
        for name, struct in _structs.found.items()
        if issubclass(struct, _structs.Struct)
    }


@pytest.fixture(scope="module")
def layouts():
    """Size and fields of each struct in C: name, offset and size."""
    program = os.environ.get("GEODISK_STRUCT_LAYOUTS")
    if not program:
        pytest.skip("GEODISK_STRUCT_LAYOUTS names no program")
    found = {}
    for line in subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines():
        struct, *field, size = line.split()
        if field:
            found[struct][1].append((field[0], int(field[1]), int(size)))
        else:
            found[struct] = (int(size), [])
    return found


def test_each_struct_is_mirrored_or_unused(layouts):
    assert sorted(layouts) == sorted([*mirrored(), *UNUSED])


@pytest.mark.parametrize("name", sorted(mirrored()))
def test_fields_lie_where_they_do_in_c(layouts, name):
    struct = mirrored()[name]
    fields = [(field, getattr(struct, field).offset, getattr(struct, field).size) for field, _ in struct._fields_]
    assert (ctypes.sizeof(struct), fields) == layouts[name]


def test_points_lie_as_they_do_in_c(layouts):
    fields = [(name, offset, kind.itemsize) for name, (kind, offset) in POINT.fields.items()]
    assert (POINT.itemsize, fields) == layouts["geodisk_surface_point"]


def test_each_function_has_its_types():
    headers = c.ask("geodisk_python_headers").decode()
    text = _structs._COMMENT.sub("", headers)
    assert len(_structs._FUNCTION.findall(text)) == text.count("GEODISK_C_API ") > 100


def test_structs_keep_what_they_point_to():
    points, inner = np.arange(6.0), _structs.SurfaceParams(seed=7)
    names = (ctypes.c_char_p * 1)(b"uv")
    address, kept = points.ctypes.data, [weakref.ref(one) for one in (points, inner, names)]
    params = _structs.CellParams(samples=points, sample_count=6, face_mask=None)
    request, source = _structs.Request(params=inner), _structs.SourceParams(attributes=names)
    assert params.samples == address and request.params == ctypes.addressof(inner)
    del points, inner, names
    gc.collect()
    assert all(one() is not None for one in kept)
    del params, request, source
    gc.collect()
    assert all(one() is None for one in kept)
