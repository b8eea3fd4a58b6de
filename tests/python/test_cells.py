"""The geodesic Voronoi cells of samples."""

import numpy as np
import pytest

import geodisk
from meshes import FACES, VERTICES

KNOT = geodisk.Mesh("builtin:torus-knot:8")


def test_cells_of_a_set():
    samples = geodisk.sample(KNOT, min_distance=0.25, maximal=True)
    cells = geodisk.cells(KNOT, samples)
    corners = KNOT.vertices[KNOT.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(normals, axis=1).sum() / 2
    assert len(cells) == len(samples) and np.isclose(cells.area.sum(), area, rtol=1e-9)
    assert cells == cells and cells != geodisk.cells(KNOT, samples) and cells in {cells}
    assert cells.unreached == 0 and 0 < cells.area_error < cells.area.min() / 20
    assert cells.edges.shape[1] == 2 and (cells.edges[:, 0] < cells.edges[:, 1]).all()
    assert cells.mesh_euler == 0 and "triangles" in repr(cells)
    assert cells.euler == len(samples) - len(cells.edges) + len(cells.triangles)
    sides = np.sort(cells.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    known = {tuple(edge) for edge in cells.edges.tolist()}
    assert {tuple(side) for side in sides.tolist()} <= known
    places = (samples.face_index, samples.barycentric)
    areas = geodisk.cells(KNOT, places, dual=False)
    assert np.array_equal(areas.area, cells.area) and areas.triangles.shape == (0, 3)


def test_areas_of_masked_samples_sum_to_the_masked_area():
    corners = VERTICES[FACES]
    areas = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    ) / 2
    mask = corners.mean(axis=1)[:, 2] > 0
    mesh = geodisk.Mesh(VERTICES, FACES)
    samples = geodisk.sample(mesh, min_distance=0.4, face_mask=mask)
    cells = geodisk.cells(mesh, samples, face_mask=mask)
    assert np.isclose(cells.area.sum(), areas[mask].sum(), rtol=1e-6)
    by_index = geodisk.cells(mesh, samples, face_mask=np.flatnonzero(mask))
    assert np.array_equal(by_index.area, cells.area)


def test_cells_tell_how_far_they_are():
    samples = geodisk.sample(KNOT, min_distance=0.5)
    heard = []
    geodisk.cells(KNOT, samples, progress=lambda part, done: heard.append((part, done)))
    assert heard[-1] == (1, len(samples))
    with pytest.raises(geodisk.Cancelled):
        geodisk.cells(KNOT, samples, progress=lambda *_: False)


def test_cells_that_cannot_be_found():
    mesh = geodisk.Mesh(VERTICES, FACES)
    with pytest.raises(geodisk.InvalidArgument, match="there is no sample"):
        geodisk.cells(mesh, (np.empty(0, int), np.empty((0, 3))))
    with pytest.raises(geodisk.InvalidArgument):
        geodisk.cells(mesh, ([10**6], [[1, 0, 0]]))
    with pytest.raises(geodisk.OutOfMemory, match="more than the 1 that are allowed"):
        geodisk.cells(mesh, ([0, 1], [[1, 0, 0], [0, 1, 0]]), max_records=1)
    bare = geodisk.sample_box([1, 1], min_distance=0.5)
    with pytest.raises(geodisk.InvalidArgument, match=r"samples: samples in a box lie on no mesh"):
        geodisk.cells(mesh, bare)
    with pytest.raises(TypeError):
        geodisk.cells(mesh, 3)
