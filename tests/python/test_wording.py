"""Words of messages and names of exceptions: those that users of Python know."""

import copy
import pickle
import traceback
import warnings

import pytest

import geodisk
from geodisk._wording import in_python
from test_mesh_sources import CUBE


@pytest.mark.parametrize(
    "told, expected",
    [
        ("2 edges nearly coincide. --weld=1e-6 joins them", "2 edges nearly coincide. weld=1e-6 joins them"),
        ("Leave out --keep-seams to join them", "Leave out keep_seams to join them"),
        ("--mesh-format: 'doc' is none of gltf", "mesh_format: 'doc' is none of gltf"),
        ("--min-distance and --radius contradict", "min_distance and radius contradict"),
        ("--weld-b: negative (see geodisk transfer --help)", "weld: negative"),
        ("turned over; --lift normals pulls them apart", "turned over"),
        ("out of memory; give more with --memory", "out of memory"),
        ("out of memory; give --weld", "out of memory; give weld"),
        ("lower --count, or raise --darts", "lower count, or raise darts"),
        ("a--weld.obj: damaged", "a--weld.obj: damaged"),
        ("--weld.obj: damaged", "--weld.obj: damaged"),
        ("x/--weld: damaged", "x/--weld: damaged"),
    ],
)
def test_options_are_parameters(told, expected):
    assert in_python(told) == expected


def test_warnings_name_parameters():
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        apart = [CUBE[[0, 1, 2]], CUBE[[1, 2, 3]] + 1e-8]
        geodisk.Mesh([*apart[0], *apart[1]], [[0, 1, 2], [3, 4, 5]])
        geodisk.Mesh(CUBE[[0, 1, 2, 1, 2, 3]], [[0, 1, 2], [3, 4, 5]], keep_seams=True)
    told = " ".join(str(one.message) for one in caught)
    assert " weld=" in told and " keep_seams " in told and "--" not in told


EXCEPTIONS = [
    kind
    for kind in map(geodisk.__dict__.get, geodisk.__all__)
    if isinstance(kind, type) and issubclass(kind, Exception)
]


@pytest.mark.parametrize("kind", EXCEPTIONS)
def test_exceptions_have_their_public_names(kind):
    error = kind("no face")
    error.element = 3
    shown = traceback.format_exception_only(kind, error)
    assert shown == [f"geodisk.{kind.__name__}: no face\n"]
    for again in (pickle.loads(pickle.dumps(error)), copy.deepcopy(error)):
        assert type(again) is kind and again.args == error.args and vars(again) == vars(error)
