"""Samples as objects of other packages, and functions with the arguments of these packages."""

import sys
import types

import numpy as np
import pytest

import geodisk
from geodisk import compat
from meshes import FACES, LENGTHS, VERTICES, same

COLOURS = np.full((len(VERTICES), 4), [51, 102, 255, 255], np.uint8)
MESH = types.SimpleNamespace(
    vertices=VERTICES, faces=FACES, vertex_attributes={"paint": COLOURS, "heat": VERTICES[:, 0]}
)
NAMES = "points normals face_index barycentric radius order color heat".split()


@pytest.fixture(scope="module")
def samples():
    return geodisk.sample(MESH, min_distance=0.5, attributes="all")


def test_numpy_and_dlpack(samples):
    arrays = samples.to("numpy")
    assert list(arrays) == NAMES and arrays["points"] is samples.points
    copies = samples.to("dlpack")
    assert list(copies) == NAMES
    for name, array in copies.items():
        assert np.array_equal(array, arrays[name]) and array.dtype in (np.float64, np.int64, np.int32)
        assert np.array_equal(np.from_dlpack(array), array)
        assert not np.shares_memory(array, arrays[name])


def test_columns_are_there_as_well(samples):
    classes = geodisk.sample(MESH, min_distance=0.7, classes=2).to("numpy")
    assert set(classes["class"]) == {0, 1}
    bare = geodisk.sample(len(VERTICES), FACES, edge_lengths=LENGTHS, min_distance=0.5)
    assert "points" not in bare.to("dlpack")


def test_torch(samples):
    torch = pytest.importorskip("torch")
    tensors = samples.to("torch")
    assert list(tensors) == NAMES and tensors["face_index"].dtype == torch.int64
    tensors["points"] += 1
    assert np.array_equal(tensors["points"].numpy(), samples.points + 1)
    assert same(geodisk.sample(torch.tensor(VERTICES), torch.tensor(FACES), min_distance=0.5), samples)


def test_pyvista(samples):
    pytest.importorskip("pyvista")
    cloud = samples.to("pyvista")
    assert np.array_equal(cloud.points, samples.points)
    assert set(cloud.point_data) == {"Normals", *NAMES[2:]}
    assert np.allclose(cloud.active_normals, samples.normals)
    assert cloud["color"].dtype == np.uint8 and cloud["color"].tolist()[0] == [51, 102, 255, 255]
    assert cloud.active_scalars_name == "color"
    flat = geodisk.sample_box([1, 2], min_distance=0.3)
    assert np.array_equal(flat.to("pyvista").points[:, :2], flat.points)


def test_trimesh(samples):
    pytest.importorskip("trimesh")
    cloud = samples.to("trimesh")
    assert np.array_equal(cloud.vertices, samples.points)
    assert (cloud.colors == [51, 102, 255, 255]).all()
    assert set(cloud.metadata) == {*NAMES[1:]} - {"color"}


def test_open3d(samples):
    pytest.importorskip("open3d")
    cloud = samples.to("open3d")
    assert np.array_equal(cloud.point["face_index"].numpy(), samples.face_index)
    assert np.array_equal(cloud.point["heat"].numpy(), samples.attributes["heat"])
    legacy = cloud.to_legacy()
    assert np.array_equal(legacy.points, samples.points) and legacy.has_normals()
    assert np.allclose(legacy.colors, [0.2, 0.4, 1])


@pytest.mark.parametrize("kind", ["torch", "pyvista", "trimesh", "open3d"])
def test_packages_that_are_missing(kind, samples, monkeypatch):
    monkeypatch.setitem(sys.modules, kind, None)
    with pytest.raises(ImportError, match=rf"to\('{kind}'\) needs {kind} \(pip install {kind}\)"):
        samples.to(kind)


def test_what_cannot_be_converted(samples, monkeypatch):
    with pytest.raises(geodisk.InvalidArgument, match="kind is 'vtk', none of numpy, torch"):
        samples.to("vtk")
    monkeypatch.setitem(sys.modules, "pyvista", types.SimpleNamespace())
    with pytest.raises(geodisk.InvalidArgument, match=r"4 coordinates, not 3; give to\('numpy'\)"):
        geodisk.sample_box([1] * 4, min_distance=0.5).to("pyvista")
    bare = geodisk.sample(len(VERTICES), FACES, edge_lengths=LENGTHS, min_distance=0.5)
    with pytest.raises(geodisk.InvalidArgument, match="have no points"):
        bare.to("pyvista")
    own = geodisk.Samples([[0, 0]], attributes={"radius": [1]})
    with pytest.raises(geodisk.InvalidArgument, match="rename it"):
        own.to("numpy")


def test_even_samples_of_trimesh():
    points, faces = compat.trimesh.sample_surface_even(MESH, 200, seed=4)
    assert points.shape == (200, 3) and faces.shape == (200,) and faces.dtype == np.int64
    again = compat.trimesh.sample_surface_even(MESH, 200, seed=4)
    assert np.array_equal(again[0], points) and np.array_equal(again[1], faces)
    assert not np.array_equal(compat.trimesh.sample_surface_even(MESH, 200)[0][:9], points[:9])
    some = np.random.default_rng(1)
    points, _ = compat.trimesh.sample_surface_even(MESH, 20, radius=0.8, seed=some)
    away = np.linalg.norm(points[:, None] - points[None], axis=-1)[np.triu_indices(20, 1)]
    assert len(points) == 20 and away.min() > 0.5
    with pytest.warns(geodisk.GeodiskWarning, match="only"):
        assert len(compat.trimesh.sample_surface_even(MESH, 9999, radius=0.8)[0]) < 9999


def test_poisson_disks_of_open3d():
    package = pytest.importorskip("open3d")
    mesh = package.geometry.TriangleMesh.create_sphere()
    cloud = compat.open3d.sample_points_poisson_disk(mesh, 100)
    assert len(cloud.points) == 100 and not cloud.has_normals() and not cloud.has_colors()
    mesh.compute_vertex_normals()
    mesh.paint_uniform_color([1, 0.5, 0])
    cloud = compat.open3d.sample_points_poisson_disk(mesh, number_of_points=100, init_factor=5, seed=1)
    directions = np.asarray(cloud.points) / np.linalg.norm(cloud.points, axis=1, keepdims=True)
    assert np.allclose(cloud.normals, directions, atol=0.1) and np.allclose(cloud.colors, [1, 0.5, 0])
    flat = compat.open3d.sample_points_poisson_disk(mesh, 100, use_triangle_normal=True, seed=1)
    assert np.array_equal(flat.points, cloud.points) and not np.allclose(flat.normals, cloud.normals)
    tensors = package.t.geometry.TriangleMesh.create_sphere()
    with pytest.raises(TypeError, match=r"not TriangleMesh; give mesh.to_legacy\(\)"):
        compat.open3d.sample_points_poisson_disk(tensors, 100)
    with pytest.raises(geodisk.InvalidArgument, match="pcl"):
        compat.open3d.sample_points_poisson_disk(mesh, 100, pcl=cloud)


def test_what_is_no_mesh_of_open3d():
    with pytest.raises(TypeError, match="open3d.geometry.TriangleMesh, not NoneType"):
        compat.open3d.sample_points_poisson_disk(None, 100)


class Tensor:
    """As much of torch as distances need."""

    def __init__(self, array):
        self.array, self.dtype = np.asarray(array), np.asarray(array).dtype

    def __array__(self, *_, **__):
        return self.array

    def to(self, dtype):
        return Tensor(self.array.astype(dtype))


@pytest.mark.filterwarnings("ignore::geodisk.MeshWarning")
def test_distances_of_pyg(monkeypatch):
    try:
        from torch import tensor
    except ImportError:
        tensor = Tensor
        monkeypatch.setitem(sys.modules, "torch", types.SimpleNamespace(from_numpy=Tensor))
    pos = tensor(np.array([[0, 0, 0], [2, 0, 0], [0, 2, 0], [2, 2, 0]], np.float32))
    face = tensor(np.array([[0, 0], [1, 2], [3, 3]]))
    distance = lambda *given, **named: compat.pyg.geodesic_distance(pos, face, *given, **named)
    far = 2**0.5
    expected = np.array([[0, 1, 1, far], [1, 0, far, 1], [1, far, 0, 1], [far, 1, 1, 0]])
    found = distance()
    assert found.dtype == pos.dtype and np.allclose(found, expected)
    assert np.allclose(distance(norm=False), 2 * expected)
    twice = tensor(np.array([0, 0, 0, 3]))
    assert np.allclose(distance(twice), expected[[0, 0, 0, 3]])
    assert np.allclose(distance(twice, tensor(np.array([0, 1, 2, 2]))), [0, 1, 1, 1])
    assert np.allclose(distance(dst=twice), [0, 1, 1, 0])
    with pytest.raises(geodisk.InvalidArgument, match=r"face has the shape \(2, 3\), not \(3, f\)"):
        compat.pyg.geodesic_distance(pos, np.asarray(face).T)
    near = np.asarray(distance(max_distance=1.2))
    assert np.array_equal(np.isinf(near), expected > 1.2) and np.allclose(near[0, :3], [0, 1, 1])
