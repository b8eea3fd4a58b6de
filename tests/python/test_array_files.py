"""Meshes that VTK, PyVista and nibabel write, and samples that they read."""

import os
import subprocess

import numpy as np
import pytest

import geodisk
from meshes import FACES, VERTICES


@pytest.fixture(scope="module")
def sphere():
    """A sphere of PyVista with attributes of points and cells, in single precision."""
    pyvista = pytest.importorskip("pyvista")
    mesh = pyvista.Sphere(theta_resolution=12, phi_resolution=9).triangulate()
    mesh.point_data["heat"] = mesh.points[:, 2].astype(np.float64)
    mesh.point_data["wind"] = mesh.points * np.float32(2)
    mesh.point_data["RGB"] = ((mesh.points + 0.5) * 255).astype(np.uint8)
    mesh.cell_data["region"] = np.arange(mesh.n_cells, dtype=np.int64)
    return mesh


def check_surface(path, mesh):
    """Requires the points, triangles and attributes of `mesh`."""
    read = geodisk.Mesh(path, attributes="all")
    assert np.allclose(read.vertices, mesh.points, atol=1e-6)
    assert np.array_equal(read.triangles, mesh.faces.reshape(-1, 4)[:, 1:])
    assert np.allclose(read.attributes["heat"], mesh.point_data["heat"], atol=1e-6)
    assert np.allclose(read.attributes["wind"], mesh.point_data["wind"], atol=1e-6)
    assert np.allclose(read.attributes["color"], mesh.point_data["RGB"] / 255)
    assert np.array_equal(read.attributes["region"], mesh.cell_data["region"])


@pytest.mark.parametrize("order", ["LittleEndian", "BigEndian"])
@pytest.mark.parametrize("head", [32, 64])
@pytest.mark.parametrize("packed", [False, True])
@pytest.mark.parametrize("mode", ["ascii", "binary", "raw", "base64"])
def test_files_of_vtk_in_xml_are_read(mode, packed, head, order, sphere, tmp_path):
    vtk = pytest.importorskip("vtk")
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetInputData(sphere)
    writer.SetFileName(str(tmp_path / "a.vtp"))
    writer.SetDataMode({"ascii": 0, "binary": 1}.get(mode, 2))
    writer.SetEncodeAppendedData(mode == "base64")
    writer.SetCompressorType(1 if packed else 0)  # ZLIB or NONE.
    writer.SetBlockSize(1024)
    writer.SetHeaderType(head)
    writer.SetByteOrder(1 if order == "LittleEndian" else 0)
    assert writer.Write() == 1
    check_surface(tmp_path / "a.vtp", sphere)


@pytest.mark.parametrize("version", [42, 51])
@pytest.mark.parametrize("binary", [False, True])
@pytest.mark.parametrize("kind", ["PolyData", "UnstructuredGrid"])
def test_legacy_files_of_vtk_are_read(kind, binary, version, sphere, tmp_path):
    vtk = pytest.importorskip("vtk")
    writer = getattr(vtk, f"vtk{kind}Writer")()
    writer.SetInputData(sphere if kind == "PolyData" else sphere.cast_to_unstructured_grid())
    writer.SetFileName(str(tmp_path / "a.vtk"))
    writer.SetFileType(2 if binary else 1)
    writer.SetFileVersion(version)
    assert writer.Write() == 1
    check_surface(tmp_path / "a.vtk", sphere)


@pytest.mark.parametrize("name", ["a.vtp", "a.vtk"])
def test_strips_of_vtk_have_the_area_of_their_triangles(name, sphere, tmp_path):
    vtk = pytest.importorskip("vtk")
    pyvista = pytest.importorskip("pyvista")
    stripper = vtk.vtkStripper()
    stripper.SetInputData(sphere)
    stripper.Update()
    strips = pyvista.wrap(stripper.GetOutput())
    assert strips.GetNumberOfStrips() > 0
    strips.save(tmp_path / name)
    mesh = geodisk.Mesh(tmp_path / name)
    assert len(mesh.triangles) == sphere.n_cells
    assert mesh.area == pytest.approx(sphere.area, rel=1e-5)


def test_a_grid_with_volumes_is_refused_by_name(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    pyvista.ImageData(dimensions=(3, 3, 3)).cast_to_unstructured_grid().save(tmp_path / "a.vtk")
    with pytest.raises(geodisk.MeshRejected, match="cell 0 is a (voxel|hexahedron)"):
        geodisk.Mesh(tmp_path / "a.vtk")


@pytest.mark.parametrize("endian", ["little", "big"])
@pytest.mark.parametrize("encoding", ["ASCII", "B64BIN", "B64GZ"])
def test_surfaces_of_gifti_are_read(encoding, endian, tmp_path):
    nibabel = pytest.importorskip("nibabel")
    gifti = nibabel.gifti
    vertices, faces = np.asarray(VERTICES, np.float32), np.asarray(FACES, np.int32)

    def array(values, intent, **more):
        code = f"GIFTI_ENCODING_{encoding}"
        return gifti.GiftiDataArray(values, f"NIFTI_INTENT_{intent}", encoding=code, endian=endian, **more)

    heat = array(vertices[:, 0].copy(), "SHAPE", meta=gifti.GiftiMetaData(Name="heat"))
    image = gifti.GiftiImage(darrays=[array(vertices, "POINTSET"), array(faces, "TRIANGLE"), heat])
    nibabel.save(image, tmp_path / "a.surf.gii")
    mesh = geodisk.Mesh(tmp_path / "a.surf.gii", attributes=["heat"])
    assert np.allclose(mesh.vertices, vertices) and np.array_equal(mesh.triangles, faces)
    assert np.allclose(mesh.attributes["heat"], vertices[:, 0])


def test_surfaces_of_freesurfer_are_read(tmp_path):
    nibabel = pytest.importorskip("nibabel")
    vertices = np.asarray(VERTICES, np.float32)
    nibabel.freesurfer.write_geometry(tmp_path / "lh.white", vertices, np.asarray(FACES))
    mesh = geodisk.Mesh(tmp_path / "lh.white")
    assert np.array_equal(mesh.vertices, vertices) and np.array_equal(mesh.triangles, FACES)


@pytest.mark.skipif("GEODISK_COMMAND" not in os.environ, reason="needs the program")
@pytest.mark.parametrize("name", ["lh.curv", "lh.shape.gii"])
def test_values_of_vertices_are_a_density(name, tmp_path):
    nibabel = pytest.importorskip("nibabel")
    values = (np.asarray(VERTICES)[:, 0] > 0).astype(np.float32)
    if name.endswith("gii"):
        array = nibabel.gifti.GiftiDataArray(values, "NIFTI_INTENT_SHAPE")
        nibabel.save(nibabel.gifti.GiftiImage(darrays=[array]), tmp_path / name)
    else:
        nibabel.freesurfer.write_morph_data(tmp_path / name, values)
    nibabel.freesurfer.write_geometry(tmp_path / "lh.white", np.asarray(VERTICES), np.asarray(FACES))
    command = [os.environ["GEODISK_COMMAND"], "sample", "lh.white", "-d", "0.3", "-q", "-o", "a.npz"]
    subprocess.run([*command, "--density", f"file:{name}"], cwd=tmp_path, check=True)
    samples = geodisk.read(tmp_path / "a.npz")
    assert len(samples) > 50 and samples.points[:, 0].min() > -0.5


@pytest.mark.skipif("GEODISK_COMMAND" not in os.environ, reason="needs the program")
def test_annotations_and_labels_of_freesurfer_are_masks(tmp_path):
    nibabel = pytest.importorskip("nibabel")
    vertices = np.asarray(VERTICES)
    numbers = (vertices[:, 0] > 0).astype(int) * 2  # Of "c" and "a".
    table = np.array([[10, 20, 30, 0, 0], [1, 2, 3, 0, 0], [40, 50, 60, 0, 0]])
    nibabel.freesurfer.write_annot(tmp_path / "lh.a.annot", numbers, table, ["a", "b", "c"], fill_ctab=True)
    inside = np.flatnonzero(numbers)
    lines = [f"{v} {' '.join(map(str, vertices[v]))} 0.0" for v in inside]
    (tmp_path / "lh.c.label").write_text(f"#!ascii label , from subject a\n{len(inside)}\n" + "\n".join(lines) + "\n")
    assert np.array_equal(nibabel.freesurfer.read_label(tmp_path / "lh.c.label"), inside)
    nibabel.freesurfer.write_geometry(tmp_path / "lh.white", vertices, np.asarray(FACES))

    mesh = geodisk.Mesh(tmp_path / "lh.white", attributes=[f"file:{tmp_path}/lh.a.annot"])
    assert np.array_equal(mesh.attributes["lh.a.annot"], nibabel.freesurfer.read_annot(tmp_path / "lh.a.annot")[0])
    found = []
    for mask in ["file:lh.a.annot=c", "file:lh.c.label"]:
        command = [os.environ["GEODISK_COMMAND"], "sample", "lh.white", "-d", "0.3", "-q", "-o", "a.npz"]
        subprocess.run([*command, "--mask", mask], cwd=tmp_path, check=True)
        samples = geodisk.read(tmp_path / "a.npz")
        assert numbers[mesh.triangles[samples.face_index]].all()
        found.append(samples.points)
        os.remove(tmp_path / "a.npz")
    assert len(found[0]) > 50 and np.array_equal(*found)


@pytest.mark.skipif("GEODISK_COMMAND" not in os.environ, reason="needs the program")
@pytest.mark.parametrize("each", [False, True])
def test_distances_are_shapes_of_gifti(each, tmp_path):
    nibabel = pytest.importorskip("nibabel")
    vertices, faces = np.asarray(VERTICES), np.asarray(FACES)
    apart = np.concatenate([vertices, vertices[:3] + 100])  # No path leads there.
    with_part = np.concatenate([faces, [[len(vertices), len(vertices) + 1, len(vertices) + 2]]])
    nibabel.freesurfer.write_geometry(tmp_path / "lh.white", apart, with_part)
    command = [os.environ["GEODISK_COMMAND"], "distances", "lh.white", "--vertices", "0,5", "-q"]
    more = ["--each"] if each else []
    for name in ("a.shape.gii", "a.npz"):
        subprocess.run([*command, *more, "-o", name], cwd=tmp_path, check=True, stderr=subprocess.DEVNULL)
    image = nibabel.load(tmp_path / "a.shape.gii")
    expected = np.atleast_2d(np.load(tmp_path / "a.npz")["distances"])
    assert len(image.darrays) == len(expected) == 1 + each
    for array, row in zip(image.darrays, expected):
        assert array.intent == nibabel.nifti1.intent_codes["NIFTI_INTENT_SHAPE"]
        assert array.data.dtype == np.float32 and array.data.shape == row.shape
        assert np.array_equal(np.isnan(array.data), ~np.isfinite(row)) and np.isnan(array.data[-3:]).all()
        assert np.array_equal(array.data[:-3], row[:-3].astype(np.float32))
    names = [array.meta["Name"] for array in image.darrays]
    assert names == (["distance from 0", "distance from 5"] if each else ["distance from the nearest source"])
    assert image.meta["mesh"] == "lh.white"


@pytest.mark.skipif("GEODISK_COMMAND" not in os.environ, reason="needs the program")
def test_cells_of_vertices_are_labels_of_gifti(tmp_path):
    nibabel = pytest.importorskip("nibabel")
    vertices, faces = np.asarray(VERTICES), np.asarray(FACES)
    apart = np.concatenate([vertices, vertices[:3] + 100, [[0, 0, 0]]])  # The last one is of no face.
    with_part = np.concatenate([faces, [[len(vertices), len(vertices) + 1, len(vertices) + 2]]])
    mesh = tmp_path / "lh <&> white.surf"
    nibabel.freesurfer.write_geometry(mesh, apart, with_part)
    np.savetxt(tmp_path / "points.csv", vertices[:20:2], delimiter=",", header="x,y,z", comments="")
    command = [os.environ["GEODISK_COMMAND"], "cells", mesh.name, "points.csv", "-q", "-o", "areas.csv"]
    subprocess.run([*command, "--labels", "a.label.gii"], cwd=tmp_path, check=True, stderr=subprocess.DEVNULL)
    image = nibabel.load(tmp_path / "a.label.gii")
    (array,) = image.darrays
    assert array.intent == nibabel.nifti1.intent_codes["NIFTI_INTENT_LABEL"]
    assert array.data.dtype == np.int32 and array.data.shape == (len(apart),)
    assert (array.data[-4:] == 0).all() and np.array_equal(array.data[:20:2], np.arange(1, 11))
    distances = geodisk.geodesic_distances(geodisk.Mesh(vertices, faces), range(0, 20, 2), each=True)
    own = distances[array.data[: len(vertices)] - 1, np.arange(len(vertices))]
    assert np.allclose(own, distances.min(axis=0), atol=1e-5)
    table = image.labeltable.get_labels_as_dict()
    assert table == {0: "???", **{i + 1: f"sample {i}" for i in range(10)}}
    assert all(0 <= part <= 1 for label in image.labeltable.labels for part in label.rgba)
    assert image.meta["mesh"] == mesh.name
    command[1:] = ["sample", mesh.name, "-d", "0.3", "-q", "-o", "b.npz", "--mask", "file:a.label.gii=sample 3"]
    subprocess.run(command, cwd=tmp_path, check=True, stderr=subprocess.DEVNULL)
    samples = geodisk.read(tmp_path / "b.npz")
    assert (array.data[with_part[samples.face_index]] == 4).all()


def test_samples_are_points_of_vtk_with_their_columns(sphere, tmp_path):
    pyvista = pytest.importorskip("pyvista")
    sphere.save(tmp_path / "a.vtp")
    samples = geodisk.sample(
        tmp_path / "a.vtp", min_distance=0.1, seed=3, attributes=["heat", "wind", "color"]
    )
    samples.save(tmp_path / "samples.vtp")
    read = pyvista.read(tmp_path / "samples.vtp")
    assert read.n_points == read.GetNumberOfVerts() == len(samples)
    assert np.allclose(read.points, samples.points, atol=1e-6)
    assert np.allclose(read.point_data.active_normals, samples.normals, atol=1e-6)
    assert np.array_equal(read["face_index"], samples.face_index)
    assert np.allclose(read["barycentric"], samples.barycentric)
    assert np.allclose(read["wind"], samples.attributes["wind"], atol=1e-6)
    assert np.array_equal(read["color"], np.rint(samples.attributes["color"] * 255))
    assert float(read.field_data["min_distance"][0]) == 0.1
    with pytest.raises(geodisk.MeshRejected, match="holds samples"):
        geodisk.Mesh(tmp_path / "samples.vtp")
