"""Arguments of a wrong kind are refused by their names, in words of the package."""

import inspect
import linecache
import traceback

import numpy as np
import pytest

import geodisk
from meshes import FACES, VERTICES
from test_mesh_sources import CUBE, SIDES

SAMPLES = geodisk.sample(VERTICES, FACES, min_distance=0.3, seed=5)


def near(**options):
    return geodisk.neighbours(VERTICES, FACES, **options)


def sampled(**options):
    return geodisk.sample(VERTICES, FACES, min_distance=0.5, **options)


@pytest.mark.parametrize(
    "call, kind, text",
    [
        (lambda: geodisk.Mesh("builtin:cube", attributes=3), TypeError, "attributes is 3, neither"),
        (lambda: geodisk.Mesh("builtin:cube", columns=["part", 3]), TypeError, "columns is"),
        (lambda: geodisk.Mesh("builtin:cube", mesh_format=3), TypeError, "mesh_format is 3"),
        (lambda: geodisk.Mesh(VERTICES, FACES, weld="yes"), TypeError, "weld is 'yes', not a num"),
        (lambda: geodisk.Mesh(VERTICES, FACES, weld=-1), ValueError, "weld is -1.0, neither"),
        (lambda: near(nearest=2.5), TypeError, "nearest is 2.5, not an integer"),
        (lambda: near(nearest=True), TypeError, "nearest is True, not an integer"),
        (lambda: near(nearest=np.bool_(True)), TypeError, "nearest is .*True.*, not an integer"),
        (lambda: geodisk.sample(VERTICES, FACES, radius=1, seed=True), TypeError, "seed is True, not"),
        (lambda: near(within=np.inf), ValueError, "within is inf, not positive and finite"),
        (lambda: near(sources=[0, 1], within=[1, np.nan]), ValueError, r"within\[1\] is nan"),
        (lambda: near(within=1, max_pairs=0), ValueError, "max_pairs is 0, not from 1"),
        (lambda: geodisk.cells((VERTICES, FACES), SAMPLES, max_records=0), (ValueError, TypeError), ""),
        (lambda: geodisk.farthest_order(SAMPLES, count=1.5), TypeError, "count is 1.5, not an int"),
        (lambda: geodisk.sample(VERTICES, FACES, min_distance="1"), TypeError, "min_distance is '1'"),
        (lambda: geodisk.sample(VERTICES, FACES, radius=[1, 2]), TypeError, "radius is .*not a num"),
        (lambda: geodisk.sample(VERTICES, FACES, radius=10**400), ValueError, "radius is above 1e308"),
        (lambda: geodisk.sample(VERTICES, FACES, radius=1, pool_ratio="a"), TypeError, "pool_ratio is"),
        (lambda: geodisk.sample(VERTICES, FACES, radius=1, features="a"), TypeError, "features is 'a'"),
        (lambda: geodisk.verify(SAMPLES, min_distance="a"), TypeError, "min_distance is 'a', not"),
        (lambda: geodisk.verify(SAMPLES, tolerance="a"), TypeError, "tolerance is 'a', not a number"),
        (lambda: geodisk.render(SAMPLES, size=3), ValueError, r"size is 3, not \(width, height\)"),
        (lambda: geodisk.render(SAMPLES, style=3), TypeError, "style is 3, not a text"),
        (lambda: geodisk.render(SAMPLES, view=3), TypeError, "view is 3, neither a name"),
        (lambda: geodisk.render(SAMPLES, view=[(1, 2, 3)]), TypeError, "view is .*, neither a name"),
        (lambda: geodisk.render(SAMPLES, up=1), TypeError, "up is 1, not a text"),
        (lambda: sampled(frames="upright", up="xy"), geodisk.InvalidArgument, "up is 'xy', none of x, y, z"),
        (lambda: sampled(order="progressive", level_factor=0), geodisk.InvalidArgument, "level_factor is 0, not from 1.1 to 8"),
        (lambda: sampled(device=True), TypeError, "device is True, none of devices"),
        (lambda: sampled(device=25), geodisk.NoDevice, "no Vulkan device matches"),
    ],
)
def test_what_is_refused(call, kind, text):
    with pytest.raises(kind, match=text):
        call()


def test_masks_of_integers_are_no_indices():
    cube = geodisk.Mesh(CUBE, SIDES)
    for mask in (np.ones(6, np.uint8), np.array([0, 1, 1, 0, 0, 0]), np.zeros(12, np.int64)):
        with pytest.raises(geodisk.InvalidArgument, match="zeros and ones, which must be of type bool"):
            geodisk.sample(cube, min_distance=0.2, face_mask=mask)
    assert set(geodisk.sample(cube, min_distance=0.2, face_mask=[1, 0]).face_index) == {0, 1}
    with pytest.raises(geodisk.InvalidArgument, match="mask of zeros and ones; give np.flatnonzero"):
        geodisk.neighbours(cube, sources=np.ones(8, np.uint8), within=1)


def test_weights_sum_to_one():
    samples = geodisk.Samples(face_index=[0, 1], barycentric=[[1, 0, 0], [0, 0, 0]])
    with pytest.raises(geodisk.InvalidArgument, match="sample 1 has the weights .* sum to 1"):
        samples.interpolate(VERTICES, mesh=geodisk.Mesh(VERTICES, FACES))


def test_booleans_of_numpy_are_booleans():
    soup = VERTICES[FACES].reshape(-1, 3), np.arange(3 * len(FACES)).reshape(-1, 3)
    welded = geodisk.Mesh(*soup, weld=np.bool_(True))
    assert welded.info["components"] == geodisk.Mesh(*soup, weld=True).info["components"] == 1
    far_apart = VERTICES[:3], [[0, 1, 2]]  # A distance of 1 would join them.
    assert geodisk.Mesh(*far_apart, weld=np.bool_(True)).area > 0
    assert geodisk.Mesh(*far_apart, weld=np.bool_(False)).area > 0


class Tensor:
    """Fails with advice of its own, as tensors with gradients and on GPUs do."""

    def __init__(self, error):
        self.error = error

    def __array__(self, *_, **__):
        raise self.error

    def __float__(self):
        raise self.error


@pytest.mark.parametrize("kind", [RuntimeError, TypeError])
def test_the_advice_of_an_object_that_gives_no_array_is_shown(kind):
    tensor = Tensor(kind("use tensor.detach().cpu() first"))
    advice = r"cannot be read as an array: use tensor\.detach\(\)\.cpu\(\) first"
    for call, name in (
        (lambda: geodisk.sample(tensor, FACES, min_distance=0.3), "vertices"),
        (lambda: geodisk.sample([tensor] * 3, FACES, min_distance=0.3), "vertices"),
        (lambda: geodisk.sample(VERTICES, tensor, min_distance=0.3), "faces"),
        (lambda: geodisk.sample(VERTICES, FACES, min_distance=0.3, density=tensor), "density"),
        (lambda: geodisk.Samples(points=tensor), "points"),
    ):
        with pytest.raises(TypeError, match=f"^{name} {advice}") as raised:
            call()
        assert raised.value.__cause__ is tensor.error
    with pytest.raises(TypeError, match=r"^min_distance is .*, not a number: use tensor"):
        geodisk.sample(VERTICES, FACES, min_distance=tensor)
    with pytest.raises(TypeError, match="^vertices has to be an array, with rows of one length"):
        geodisk.sample([[0, 0, 0], [1, 0]], FACES, min_distance=0.3)


def test_an_object_that_runs_out_of_memory_says_so():
    tensor = Tensor(MemoryError("of this GPU"))
    for arguments in ((tensor, FACES, 0.3), (VERTICES, tensor, 0.3), (VERTICES, FACES, tensor)):
        with pytest.raises(MemoryError, match="of this GPU"):
            geodisk.sample(*arguments[:2], min_distance=arguments[2])


def test_what_a_generator_of_meshes_raises_is_not_hidden():
    def meshes():
        yield MESH
        raise KeyError("no such model")

    with pytest.raises(KeyError, match="no such model"):
        geodisk.sample_many(meshes(), min_distance=0.5)


class Hostile:
    def __float__(self):
        raise RuntimeError

    def __repr__(self):
        return "<Hostile>"


NASTY = [
    "a\0b",
    "\ud800",
    b"abc",
    "",
    Hostile(),
    [[1], [1, 2]],
    np.array(["a", "b"]),
    np.array([None, 3]),
    np.array([2.5, np.nan]),
    np.array(0.5),
    10**400,
    1j,
    {"a": 1},
    np.full((2, 3), -1),
]
MESH = geodisk.Mesh(VERTICES, FACES)


def save(path):
    SAMPLES.save(path)


def choose(key):
    return SAMPLES[key]


def interpolate(values=VERTICES, of="vertices", nearest=None, mesh=None):
    return SAMPLES.interpolate(values, of=of, nearest=nearest, mesh=mesh)


CALLS = [
    (geodisk.Mesh, dict(vertices=VERTICES, faces=FACES)),
    (geodisk.Mesh, dict(vertices="builtin:cube")),
    (geodisk.Samples, dict(points=SAMPLES.points)),
    (geodisk.sample, dict(vertices=MESH, min_distance=0.5)),
    (geodisk.sample_many, dict(meshes=[MESH], min_distance=0.5)),
    (geodisk.sample_box, dict(min_distance=0.3)),
    (geodisk.neighbours, dict(vertices=MESH, within=0.2)),
    (geodisk.cells, dict(mesh=MESH, samples=SAMPLES)),
    (geodisk.farthest_order, dict(samples=SAMPLES, count=3)),
    (geodisk.update, dict(samples=SAMPLES, face_mask=[0])),
    (geodisk.verify, dict(samples=SAMPLES)),
    (geodisk.transfer, dict(samples=SAMPLES, to=VERTICES)),
    (geodisk.render, dict(samples=SAMPLES, size=(16, 16))),
    (geodisk.bake, dict(mesh="builtin:cube", samples=SAMPLES)),
    (geodisk.read, dict(path="a.npz")),
    (save, dict(path="a.npz")),
    (choose, dict(key=0)),
    (interpolate, {}),
]


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("function, good", CALLS, ids=lambda one: getattr(one, "__name__", ""))
def test_no_argument_makes_numpy_or_python_complain(function, good, tmp_path, monkeypatch):
    """What fails is raised by the package itself, by a statement of its own."""
    monkeypatch.chdir(tmp_path)
    found = []
    for name, parameter in inspect.signature(function).parameters.items():
        if name.startswith("_") or name == "progress" or parameter.kind == parameter.VAR_KEYWORD:
            continue
        for value in NASTY:
            try:
                function(**{**good, name: value})
            except Exception as error:
                last = traceback.extract_tb(error.__traceback__)[-1]
                is_ours = "geodisk" in last.filename and isinstance(
                    error, (geodisk.Error, TypeError, IndexError, OSError)
                )
                statement = linecache.getline(last.filename, last.lineno).strip()
                if not (is_ours and (statement.startswith("raise") or isinstance(error, OSError))):
                    found.append(f"{name}={value!r}: {type(error).__name__}: {error}")
    assert found == []
