"""Meshes and arrays of other packages, where these are installed; stand-ins for those that need a GPU."""

import types

import numpy as np
import pytest

import geodisk
from meshes import FACES, VERTICES, same

HEAT = VERTICES[:, 0].copy()
LABELS = np.arange(len(FACES))
BYTES = np.full((len(VERTICES), 3), 51, np.uint8)


def trimesh():
    package = pytest.importorskip("trimesh")
    mesh = package.Trimesh(
        VERTICES, FACES, process=False,
        vertex_attributes={"heat": HEAT}, face_attributes={"label": LABELS},
    )  # fmt: skip
    mesh.visual.vertex_colors = BYTES
    return mesh


def pyvista():
    mesh = pytest.importorskip("pyvista").PolyData.from_regular_faces(VERTICES, FACES)
    mesh.point_data.update({"heat": HEAT, "RGB": BYTES})
    mesh.point_data.active_texture_coordinates = VERTICES[:, :2]
    mesh.cell_data["label"] = LABELS
    return mesh


def vtk():
    mesh = pytest.importorskip("vtkmodules.vtkCommonDataModel").vtkPolyData()
    mesh.ShallowCopy(pyvista())
    return mesh


def grid():
    return pyvista().cast_to_unstructured_grid()


def open3d():
    package = pytest.importorskip("open3d")
    legacy = package.geometry.TriangleMesh(
        package.utility.Vector3dVector(VERTICES), package.utility.Vector3iVector(FACES.astype("i4"))
    )
    legacy.vertex_colors = package.utility.Vector3dVector(BYTES / 255)
    legacy.triangle_uvs = package.utility.Vector2dVector(VERTICES[FACES].reshape(-1, 3)[:, :2])
    return legacy


def open3d_tensors():
    package = pytest.importorskip("open3d")
    mesh = package.t.geometry.TriangleMesh.from_legacy(open3d())
    mesh.vertex["positions"] = package.core.Tensor(VERTICES)
    mesh.vertex["heat"], mesh.triangle["label"] = map(package.core.Tensor, (HEAT, LABELS))
    return mesh


def meshio():
    return pytest.importorskip("meshio").Mesh(
        VERTICES,
        [("line", [[0, 1]]), ("triangle", FACES)],
        point_data={"heat": HEAT},
        cell_data={"label": [np.array([7]), LABELS]},
    )


def vedo():
    mesh = pytest.importorskip("vedo").Mesh([VERTICES, FACES])
    mesh.pointdata["heat"], mesh.celldata["label"] = HEAT, LABELS
    return mesh


def pymeshlab():
    package = pytest.importorskip("pymeshlab")
    meshes = package.MeshSet()
    meshes.add_mesh(
        package.Mesh(vertex_matrix=VERTICES, face_matrix=FACES.astype("i4"), v_scalar_array=HEAT)
    )
    return meshes


def nibabel():
    gifti = pytest.importorskip("nibabel").gifti
    arrays = [
        gifti.GiftiDataArray(VERTICES.astype("f4"), intent="NIFTI_INTENT_POINTSET"),
        gifti.GiftiDataArray(FACES.astype("i4"), intent="NIFTI_INTENT_TRIANGLE"),
        gifti.GiftiDataArray(
            HEAT.astype("f4"), intent="NIFTI_INTENT_SHAPE", meta=gifti.GiftiMetaData(Name="heat")
        ),
        gifti.GiftiDataArray(LABELS.astype("i4"), intent="NIFTI_INTENT_LABEL"),
    ]
    return gifti.GiftiImage(darrays=arrays)


def nilearn():
    return pytest.importorskip("nilearn.surface").InMemoryMesh(VERTICES, FACES)


def pyg():
    torch, data = pytest.importorskip("torch"), pytest.importorskip("torch_geometric.data")
    return data.Data(
        pos=torch.tensor(VERTICES, requires_grad=True),
        face=torch.tensor(FACES.T.copy()),
        heat=torch.tensor(HEAT),
        edge_index=torch.zeros((2, 7), dtype=torch.long),
    )


def warp():
    package = pytest.importorskip("warp")
    points = package.array(VERTICES.astype("f4"), dtype=package.vec3, device="cpu")
    corners = package.array(FACES.astype("i4").ravel(), dtype=package.int32, device="cpu")
    return package.Mesh(points=points, indices=corners)


class Meshes:
    """A batch of PyTorch3D."""

    def __init__(self, count=1, features=BYTES / 255):
        self._count = count
        self.textures = types.SimpleNamespace(verts_features_list=lambda: [features] * count)

    def verts_list(self):
        return [Tensor(VERTICES)] * self._count

    def faces_list(self):
        return [Tensor(FACES)] * self._count

    def __len__(self):
        return self._count

    def __getitem__(self, i):
        if i >= self._count:
            raise IndexError
        return Meshes()


class Tensor:
    """An array of torch that has gradients and is on a device."""

    def __init__(self, array, has_gradients=True, is_on_host=False):
        self._array, self._has_gradients, self._is_on_host = array, has_gradients, is_on_host
        self.shape, self.ndim = array.shape, array.ndim

    def __len__(self):
        return len(self._array)

    def detach(self):
        return Tensor(self._array, False, self._is_on_host)

    def cpu(self):
        return Tensor(self._array, self._has_gradients, True)

    def numpy(self):
        if self._has_gradients or not self._is_on_host:
            raise TypeError("Can't convert cuda:0 device type tensor to numpy.")
        return self._array

    def __array__(self, *_, **__):
        return self.numpy()

    def __dlpack__(self, **_):
        raise AssertionError


class BFloat(Tensor):
    """One of a type that numpy does not have."""

    def numpy(self):
        raise TypeError("Got unsupported ScalarType BFloat16")

    def detach(self):
        return self

    cpu = detach


class FailingPath:
    """A path of trimesh, with a property that fails."""

    vertices, entities = VERTICES, ()

    @property
    def convex_hull(self):
        raise RuntimeError("QH6214 qhull input error")


class CuPyArray:
    """An array of CuPy."""

    def __init__(self, array):
        self._array = array

    def get(self):
        return self._array

    def __array__(self, *_, **__):
        raise TypeError("Implicit conversion to a NumPy array is not allowed.")

    def __dlpack__(self, **_):
        raise AssertionError


class DeviceArray:
    """An array on a device that has nothing but DLPack."""

    def __init__(self, array):
        self._array = array

    def __dlpack_device__(self):
        return 2, 0

    def __dlpack__(self, *, dl_device=None, copy=None, **options):
        if dl_device != (1, 0):
            raise BufferError("is on a device")
        return self._array.__dlpack__()


class HostArray(DeviceArray):
    def __dlpack_device__(self):
        return 1, 0

    def __dlpack__(self, **_):
        return self._array.__dlpack__()


BOTH = ("heat", "label")
KINDS = {
    trimesh: (*BOTH, "color"),
    pyvista: (*BOTH, "color", "uv"),
    vtk: (*BOTH, "color", "uv"),
    grid: (*BOTH, "color", "uv"),
    open3d: ("color", "uv"),
    open3d_tensors: (*BOTH, "color", "uv"),
    meshio: BOTH,
    vedo: BOTH,
    pymeshlab: ("scalar",),
    nibabel: BOTH,
    nilearn: (),
    pyg: ("heat",),
    warp: (),
    Meshes: ("color",),
}


@pytest.mark.parametrize("make", KINDS)
def test_meshes_and_their_attributes(make):
    expected = geodisk.sample(VERTICES, FACES, min_distance=0.5)
    samples = geodisk.sample(make(), min_distance=0.5, attributes="all" if KINDS[make] else ())
    rounded = geodisk.sample(VERTICES.astype("f4"), FACES, min_distance=0.5)
    assert same(samples, expected) or same(samples, rounded)
    found = samples.attributes
    assert set(KINDS[make]) <= set(found)
    for name in {"heat", "scalar"} & set(found):
        assert np.allclose(found[name], samples.points[:, 0], atol=1e-5)
    if "label" in found:
        assert np.array_equal(found["label"], samples.face_index)
    if "color" in KINDS[make]:
        assert np.allclose(found["color"][:, :3], 0.2, atol=1e-6)
    if "uv" in found:
        assert np.allclose(found["uv"], samples.points[:, :2], atol=1e-5)


def torch(array):
    package = pytest.importorskip("torch")
    return package.tensor(array, requires_grad=array.dtype.kind == "f")


def jax(array):
    return pytest.importorskip("jax.numpy").asarray(array)


def warp_array(array):
    return pytest.importorskip("warp").array(np.asarray(array), device="cpu")


@pytest.mark.parametrize(
    "make", [torch, jax, warp_array, Tensor, CuPyArray, DeviceArray, HostArray]
)
def test_arrays(make):
    if make is DeviceArray and np.lib.NumpyVersion(np.__version__) < "2.1.0":
        pytest.skip("numpy takes no device")
    expected = geodisk.sample(VERTICES.astype("f4"), FACES, min_distance=0.5)
    vertices, faces = make(VERTICES.astype("f4")), make(FACES.astype("i4"))
    ones = make(np.ones(len(VERTICES)))
    samples = geodisk.sample(vertices, faces, min_distance=0.5, density=ones)
    assert same(samples, expected) and type(samples._surface.vertices) is np.ndarray
    again = geodisk.Samples(make(samples.points), make(samples.normals))
    assert np.allclose(again.points, expected.points)
    assert np.allclose(samples.interpolate(vertices), samples.points, atol=1e-5)
    distances = geodisk.geodesic_distances(vertices, faces, 0)
    assert np.array_equal(distances, geodisk.geodesic_distances(VERTICES.astype("f4"), FACES, 0))


def test_attributes_by_name():
    mesh = types.SimpleNamespace(
        vertices=VERTICES,
        faces=FACES,
        vertex_attributes={"heat": HEAT**2, "name": ["a"] * len(HEAT), "gap": HEAT * np.nan},
        face_attributes={"heat": LABELS, "Normals": VERTICES[FACES][:, 0], "few": LABELS[:5]},
    )
    density = geodisk.sample(mesh, min_distance=0.5, density="heat", attributes=["face_heat"])
    assert set(density.attributes) == {"heat", "face_heat"}
    with pytest.warns(geodisk.MeshWarning, match="left out") as caught:
        assert set(geodisk.Mesh(mesh, attributes="all").attributes) == {"heat", "face_heat"}
    assert [str(one.message).split("'")[1] for one in caught] == ["name", "gap", "few"]
    assert {one.message.kind for one in caught} == {"attribute_left_out"}
    for name, text in [
        ("nosuch", "no attribute 'nosuch', only heat, name, gap, face_heat, few"),
        ("name", "'name' has values of <U1, not numbers"),
        ("gap", "'gap' has values that are not finite"),
        ("few", r"'few' has the shape \(5,\), but the mesh has 1600 faces"),
    ]:
        with pytest.raises(geodisk.MeshRejected, match=text):
            geodisk.Mesh(mesh, attributes=[name])
    with pytest.raises(TypeError, match="give values to samples.interpolate"):
        geodisk.Mesh(VERTICES, FACES, attributes="all")


def test_attributes_of_polygons_and_of_a_pose():
    cube = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
    sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    mesh = types.SimpleNamespace(
        points=cube,
        faces=np.insert(sides, 0, 4, axis=1).ravel(),
        point_data={"x": cube[:, 0]},
        cell_data={"side": np.arange(8)},
        n_verts=2,
    )
    samples = geodisk.sample(mesh, min_distance=0.3, attributes="all")
    assert np.array_equal(samples.attributes["side"], samples.polygon_index + 2)
    assert np.allclose(samples.attributes["x"], samples.points[:, 0], atol=1e-6)
    posed = geodisk.transfer(samples[:9], types.SimpleNamespace(**{**vars(mesh), "points": 2 * cube}))
    assert np.allclose(posed.points, 2 * samples.points[:9])


def test_values_of_cells_are_those_of_their_triangles():
    mesh = types.SimpleNamespace(
        points=VERTICES,
        faces=np.insert(FACES[:3], 0, 3, axis=1).ravel(),
        strips=np.array([5, *range(50, 55), 3, *range(60, 63)]),
        cell_data={"cell": np.arange(8), "few": np.arange(2)},
        point_data={},
        n_verts=1,
        n_lines=2,
    )
    with pytest.warns(geodisk.MeshWarning, match="'few'"):
        found = geodisk.Mesh(mesh, attributes="all").attributes
    assert found["cell"].tolist() == [3, 4, 5, 6, 6, 6, 7] and "few" not in found


def test_cells_of_vtk_come_in_its_order_and_arrays_without_a_name_are_left_out(tmp_path):
    package = pytest.importorskip("pyvista")
    mesh = package.PolyData(
        VERTICES,
        verts=[1, 0, 1, 1],
        lines=[2, 0, 1],
        faces=np.insert(FACES[:3], 0, 3, axis=1).ravel(),
        strips=[5, *range(50, 55)],
    )
    mesh.cell_data["cell"] = np.arange(mesh.n_cells)
    plain = vtk_named("vtkPolyData")
    plain.ShallowCopy(mesh)
    unnamed = vtk_named("vtkFloatArray")
    unnamed.SetNumberOfValues(len(VERTICES))
    plain.GetPointData().AddArray(unnamed)
    mesh.save(tmp_path / "a.vtp")
    for one in (mesh, plain, tmp_path / "a.vtp"):
        with pytest.warns(geodisk.MeshWarning):
            found = geodisk.Mesh(one, attributes="all").attributes
        assert set(found) == {"cell"}
        assert found["cell"].tolist() == [3, 4, 5, 6, 6, 6]


def test_transforms_of_gifti_are_told_as_of_files(tmp_path):
    image, package = nibabel(), pytest.importorskip("nibabel")
    image.darrays[0].coordsys.xform = 2 * np.eye(4)
    image.darrays[0].coordsys.xformspace = 3
    package.save(image, tmp_path / "a.surf.gii")
    told = []
    for one in (image, str(tmp_path / "a.surf.gii")):
        with pytest.warns(geodisk.MeshWarning, match="'NIFTI_XFORM_TALAIRACH' ignored"):
            told.append([(str(x), x.kind, x.count) for x in geodisk.Mesh(one).warnings])
    assert told[0] == told[1]


def test_batches_are_sampled_as_many():
    with pytest.raises(TypeError, match=r"2 meshes: give one, as meshes\[0\], or all to sample_many"):
        geodisk.Mesh(Meshes(2))
    a, b = geodisk.sample_many(Meshes(2), min_distance=0.5)
    assert same(a, b) and same(a, geodisk.sample(VERTICES, FACES, min_distance=0.5))


def vtk_named(name):
    return getattr(pytest.importorskip("vtkmodules.all"), name)()


@pytest.mark.parametrize(
    "make, text",
    [
        (lambda: vtk_named("vtkUnstructuredGrid"), r"extract_surface\(\).triangulate\(\)"),
        (lambda: vtk_named("vtkSphereSource"), r"give source.GetOutput\(\)"),
        (lambda: vtk_named("vtkPolyData"), r"reconstruct_surface\(\)"),
        (lambda: pytest.importorskip("pyvista").PolyData(VERTICES), r"reconstruct_surface\(\)"),
        (lambda: pytest.importorskip("open3d").geometry.PointCloud(), "points need faces"),
        (lambda: pytest.importorskip("trimesh").PointCloud(VERTICES), "points need faces"),
        (lambda: pytest.importorskip("nibabel").GiftiImage(), "load the image of a .surf.gii"),
        (lambda: types.SimpleNamespace(parts={}), r'mesh.parts\["left"\]'),
        (lambda: types.SimpleNamespace(mesh=0, data=0), r'image.mesh.parts\["left"\]'),
        (lambda: types.SimpleNamespace(pos=VERTICES, face=None), "remove_faces=False"),
        (lambda: types.SimpleNamespace(pos=None, face=FACES.T), "its pos is None: give Data"),
        (lambda: pytest.importorskip("pymeshlab").MeshSet(), "it is empty: call meshes.load"),
        (lambda: pytest.importorskip("trimesh").load_path(VERTICES[:2]), r"triangulate\(\)"),
        (lambda: FailingPath(), r"not FailingPath; lines have no faces: give \*path"),
        (lambda: types.SimpleNamespace(vertices=BFloat(VERTICES), faces=FACES), r"\.float\(\)"),
        (lambda: (VERTICES, FACES), r"give \*mesh"),
        (lambda: Tensor(VERTICES), "faces are missing"),
    ],
)
def test_objects_that_are_no_mesh(make, text):
    with pytest.raises(TypeError, match=text):
        geodisk.Mesh(make())
    with pytest.raises(geodisk.InvalidArgument, match=r"not \(3, f\)"):
        geodisk.Mesh(types.SimpleNamespace(pos=VERTICES, face=FACES))
