"""Verify, transfer and render."""

import dataclasses
import os
import pickle
import signal
import threading

import numpy as np
import pytest

import geodisk
from meshes import FACES, LENGTHS, SOUP, TETRAHEDRON, VERTICES, same, torus

SAMPLES = geodisk.sample(VERTICES, FACES, min_distance=0.3, seed=5)
ONES = np.ones(len(VERTICES))
SQUARE = geodisk.sample_box([1, 1], min_distance=0.2)
HEAVY = dataclasses.replace(SAMPLES, barycentric=2 * SAMPLES.barycentric)


def test_verify():
    found = geodisk.verify(SAMPLES)
    assert found and found.ok and found.complete and found.misplaced == 0
    assert found.samples == len(SAMPLES) and found.min_distance == 0.3
    assert 0.3 <= found.smallest < 0.31 and found.smallest_ratio == found.smallest / 0.3
    assert found.rho == pytest.approx(SAMPLES.report["rho"])
    assert found.violations.shape == (0, 2) and found.distances.shape == (0,)
    a, b = found.closest
    straight = np.linalg.norm(SAMPLES.points[a] - SAMPLES.points[b])
    assert 0.9 * found.smallest < straight <= found.smallest

    closer = geodisk.verify(SAMPLES, min_distance=0.4)
    assert not closer and len(closer.violations) > 100 and closer.min_distance == 0.4
    assert closer.violations.dtype == np.int64 and closer.distances[0] == closer.smallest
    assert tuple(closer.violations[0]) == closer.closest and np.all(closer.distances < 0.4)
    assert np.all(np.diff(closer.distances) >= 0)
    far = geodisk.verify(SAMPLES, min_distance=1e-6)
    assert far and far.closest is None and far.smallest == np.inf


def test_verify_computes_radii_again():
    factors = np.linspace(0.3, 1, len(VERTICES))
    samples = geodisk.sample(VERTICES, FACES, min_distance=0.6, radius_factor=factors, seed=2)
    found = geodisk.verify(samples, radius_factor=factors)
    assert found and found.min_distance == 0.6 and found.wrong_radii == 0
    assert found.smallest_ratio == geodisk.verify(samples).smallest_ratio
    assert found.rho == pytest.approx(samples.report["rho"])
    flatter = geodisk.verify(samples, radius_factor=factors.astype(np.float32) ** 0.9)
    assert not flatter and flatter.wrong_radii > 0.9 * len(samples) and len(flatter.violations) > 0
    assert f"{flatter.wrong_radii} of wrong radius" in repr(flatter)
    # Samples without radii of their own take those that the factors give.
    assert geodisk.verify(SAMPLES, radius_factor=factors).smallest_ratio > 1
    larger = geodisk.verify(samples, radius_factor=factors, min_distance=0.7)
    assert not larger and larger.min_distance == 0.7
    density = np.arange(len(VERTICES))
    samples = geodisk.sample(VERTICES, FACES, min_distance=0.2, density=density)
    found = geodisk.verify(samples, density=density)
    assert found and found.min_distance == pytest.approx(0.2) and found.wrong_radii == 0


def test_verify_finds_what_was_moved():
    arrays = {name: getattr(SAMPLES, name).copy() for name in ("points", "face_index")}
    arrays["barycentric"] = SAMPLES.barycentric.copy()
    for array in arrays.values():
        array[7] = array[42]
    found = geodisk.verify(dataclasses.replace(SAMPLES, **arrays))
    assert found.violations.tolist() == [[7, 42]] and found.smallest == 0
    points = SAMPLES.points.copy()
    points[3] += 0.01
    moved = geodisk.verify(dataclasses.replace(SAMPLES, points=points))
    assert not moved and moved.misplaced == 1 and len(moved.violations) == 0


def test_meshes_of_all_kinds(tmp_path):
    class Trimesh:
        vertices, faces = VERTICES, FACES

    SAMPLES.save(tmp_path / "a.npz")
    read = geodisk.read(tmp_path / "a.npz")
    expected = geodisk.verify(SAMPLES).smallest
    wide = np.zeros((len(VERTICES), 7))
    wide[:, 2:5] = VERTICES
    frozen = VERTICES.copy()
    frozen.setflags(write=False)
    for mesh in [
        (VERTICES, FACES),
        (VERTICES.tolist(), FACES.tolist()),
        (wide[:, 2:5], np.asfortranarray(FACES.astype(np.uint16))),
        (frozen.astype(">f8"), FACES.astype(np.int32)),
        (geodisk.Mesh(VERTICES, FACES),),
        (Trimesh(),),
    ]:
        assert geodisk.verify(read, *mesh).smallest == expected
    assert geodisk.verify(pickle.loads(pickle.dumps(SAMPLES)), VERTICES, FACES).smallest == expected


@pytest.mark.parametrize(
    "arguments",
    [
        {"vertices": [[0, 0], [1, 0], [0, 1]], "faces": [[0, 1, 2]], "min_distance": 0.1},
        {"vertices": VERTICES.astype(np.float32), "faces": FACES, "min_distance": 0.5},
        {"vertices": np.hstack([VERTICES, VERTICES]), "faces": FACES, "min_distance": 0.9},
        {"vertices": len(VERTICES), "faces": FACES, "edge_lengths": LENGTHS, "radius": 0.2},
        {"vertices": SOUP[0], "faces": SOUP[1], "weld": True, "min_distance": 0.5},
        {"vertices": SOUP[0], "faces": SOUP[1], "weld": 1e-9, "min_distance": 0.5},
        {"vertices": SOUP[0], "faces": SOUP[1], "min_distance": 0.5},
        {"vertices": SOUP[0], "faces": SOUP[1], "keep_seams": True, "min_distance": 0.15},
        {"vertices": VERTICES + 1e6, "faces": FACES, "min_distance": 0.5},
        {
            "vertices": VERTICES,
            "faces": FACES,
            "min_distance": 0.6,
            "density": np.linspace(0.3, 1, len(VERTICES)),
        },
    ],
)
def test_surfaces_of_all_kinds(arguments):
    samples = geodisk.sample(**arguments)
    found = geodisk.verify(samples)
    assert found and 1 <= found.smallest_ratio < 1.25 and len(samples) > 30
    assert np.isnan(found.min_distance) == ("density" in arguments)


@pytest.mark.parametrize("sides", range(1, 7))
def test_boxes(sides):
    distance = [0.01, 0.1, 0.2, 0.4, 0.5, 0.7][sides - 1]
    samples = geodisk.sample_box([1] * sides, min_distance=distance, periodic=sides == 2)
    assert distance <= geodisk.verify(samples).smallest < 1.25 * distance
    if sides == 2:  # Around the sides they are closer, where these are not glued together.
        shifted = samples.points.copy()
        shifted[:, 0] += 0.5
        outside = geodisk.verify(dataclasses.replace(samples, points=shifted))
        assert outside.misplaced == np.sum(shifted[:, 0] > 1)


def test_transfer():
    there = geodisk.transfer(SAMPLES, VERTICES * [1, 2, 3])
    assert same(there, SAMPLES) and np.array_equal(there.order, SAMPLES.order)
    assert np.allclose(there.points, SAMPLES.points * [1, 2, 3])
    found = geodisk.verify(there)
    assert found and found.smallest == pytest.approx(there.min_distance, rel=1e-12)
    assert there.min_distance > SAMPLES.min_distance
    assert np.all(there.radius == there.min_distance / 2)
    # To meshes that have other coordinates, or none.
    flat = geodisk.sample([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]], min_distance=0.1)
    raised = geodisk.transfer(flat, [[0, 0, 1], [1, 0, 1], [0, 1, 1]])
    assert raised.points.shape[1] == 3 and np.all(raised.normals == [0, 0, 1])
    lowered = geodisk.transfer(raised, [[0, 0], [1, 0], [0, 1]])
    assert np.allclose(lowered.points, flat.points) and lowered.normals is None
    mesh = geodisk.Mesh(len(VERTICES), FACES, edge_lengths=2 * LENGTHS)
    longer = geodisk.transfer(SAMPLES, mesh)
    assert longer.points is None and longer.min_distance >= 0.6
    soup = geodisk.sample(*SOUP, min_distance=0.5, weld=True)
    assert geodisk.transfer(soup, 2 * SOUP[0]).min_distance >= 1
    assert geodisk.transfer(SAMPLES[:0], 2 * VERTICES).points.shape == (0, 3)
    one = geodisk.sample(VERTICES, FACES, min_distance=0.5, stop_count=1)
    assert np.isnan(geodisk.transfer(one, VERTICES).min_distance)


def test_constraints_are_verified():
    mask = np.arange(len(FACES)) % 3 == 0
    masked = geodisk.sample(VERTICES, FACES, min_distance=0.3, face_mask=mask)
    assert geodisk.verify(masked, face_mask=mask) and geodisk.verify(masked).masked == 0
    wrong = geodisk.verify(SAMPLES, face_mask=np.nonzero(mask)[0])
    assert not wrong and wrong.masked == (~mask[SAMPLES.face_index]).sum() > 0
    assert "outside the mask" in repr(wrong)

    points = (SAMPLES[:2], [0.9, 0.5])
    clear = geodisk.sample(VERTICES, FACES, min_distance=0.3, avoid=points)
    assert geodisk.verify(clear, avoid=points)
    near = geodisk.verify(SAMPLES, avoid=points)
    assert not near and {0, 1} <= set(near.within_avoided.tolist())
    assert near.ok is False and "points to avoid" in repr(near)
    numbers = ([0], [[0.25, 0.5, 0.25]])
    bare = geodisk.Mesh(len(VERTICES), FACES, edge_lengths=LENGTHS)
    away = geodisk.sample(bare, min_distance=0.3, avoid=(numbers, 1.0), face_mask=mask)
    assert geodisk.verify(away, avoid=(numbers, 1.0), face_mask=mask)


def test_maximal_sets_are_verified():
    full = geodisk.sample(VERTICES, FACES, min_distance=0.3, maximal=True)
    found = geodisk.verify(full, maximal=True)
    assert found and found.is_maximal and found.largest_gap <= 0.3 * 1.001
    gaps = geodisk.verify(SAMPLES, maximal=True)
    assert not gaps and gaps.is_maximal is False and gaps.largest_gap > 0.3
    assert geodisk.verify(SAMPLES).is_maximal is None


def test_points_of_other_programs():
    mesh = (VERTICES, FACES)
    points = geodisk.Samples(SAMPLES.points + 1e-9)
    found = geodisk.verify(points, *mesh, min_distance=SAMPLES.min_distance * (1 - 1e-6))
    assert found and found.samples == len(SAMPLES) and found.misplaced == 0
    assert np.isclose(found.smallest, geodisk.verify(SAMPLES).smallest, rtol=1e-6)
    assert geodisk.verify(points, *mesh, min_distance=0.1, tolerance=1e-12).misplaced > 0
    with pytest.raises(ValueError, match="give min_distance"):
        geodisk.verify(points, *mesh)
    moved = geodisk.transfer(points, 2 * VERTICES, vertices=VERTICES, faces=FACES)
    assert np.allclose(moved.points, 2 * SAMPLES.points, atol=1e-7)
    assert geodisk.verify(moved) and (moved.face_index < len(FACES)).all()
    assert geodisk.render(points, *mesh, min_distance=0.1, size=(64, 48)).size == (64, 48)
    with pytest.raises(ValueError, match="lie on no mesh"):
        geodisk.verify(geodisk.sample_box([1, 1], min_distance=0.3), *mesh)


def test_render(tmp_path):
    picture = geodisk.render(SAMPLES, size=(64, 48), view=(-30, 20), background="transparent")
    assert picture.size == (64, 48) and "64 x 48" in repr(picture)
    assert picture._repr_png_() is picture.png and picture.png.startswith(b"\x89PNG")
    picture.save(tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes() == picture.png
    with pytest.raises(ValueError, match="png"):
        picture.save(tmp_path / "a.jpg")
    legend = geodisk.render(SAMPLES, size=(200, 150), legend=True)
    assert legend.png != geodisk.render(SAMPLES, size=(200, 150)).png
    sheet = geodisk.render(SAMPLES, size=(64, 48), view=["front", (1, 2)], up="z", style="points")
    assert sheet.png != picture.png
    box = geodisk.sample_box([1, 1, 1], min_distance=0.4)
    assert geodisk.render(box, size=(32, 32), cut=True).size == (32, 32)


@pytest.mark.parametrize(
    "call, kind, text",
    [
        (lambda: geodisk.verify("a.npz"), TypeError, "geodisk.read"),
        (lambda: geodisk.verify(SAMPLES, VERTICES), TypeError, "a mesh is"),
        (lambda: geodisk.verify(SAMPLES, faces=FACES), TypeError, "vertices"),
        (lambda: geodisk.verify(SAMPLES, *TETRAHEDRON), ValueError, "face 129 is out of range"),
        (lambda: geodisk.verify(SAMPLES, VERTICES, FACES - 1), geodisk.MeshRejected, "-1"),
        (lambda: geodisk.verify(SAMPLES, VERTICES * np.nan, FACES), geodisk.MeshRejected, "finite"),
        (lambda: geodisk.verify(SAMPLES, min_distance=np.nan), ValueError, "positive"),
        (lambda: geodisk.verify(SAMPLES, density=[1, 1]), ValueError, "one for each vertex"),
        (lambda: geodisk.verify(SAMPLES, density="flat"), ValueError, "density"),
        (lambda: geodisk.verify(SAMPLES, density=-ONES), ValueError, "density"),
        (lambda: geodisk.verify(SAMPLES, radius_factor=2 * ONES), ValueError, "factor"),
        (
            lambda: geodisk.verify(SAMPLES, radius_factor=ONES / 2000),
            ValueError,
            "vertex 0 is 0.0005",
        ),
        (lambda: geodisk.verify(SAMPLES, density=np.nan * ONES), ValueError, "density"),
        (lambda: geodisk.verify(SQUARE, density=ONES), ValueError, "box"),
        (lambda: geodisk.verify(SQUARE, face_mask=[0]), ValueError, "box"),
        (lambda: geodisk.verify(SQUARE, maximal=True), ValueError, "box"),
        (lambda: geodisk.verify(SAMPLES, face_mask=[]), ValueError, "leaves out all faces"),
        (lambda: geodisk.verify(SAMPLES, avoid=1), TypeError, "avoid is a pair"),
        (
            lambda: geodisk.verify(SAMPLES, avoid=(([0], [[5, -3, -1]]), 1.0)),
            ValueError,
            "avoid: point 0: its weights",
        ),
        (lambda: geodisk.verify(SAMPLES, tolerance=-1), ValueError, "tolerance: '-1.0'"),
        (lambda: geodisk.render(SAMPLES, min_distance=np.nan), ValueError, "min_distance: 'nan'"),
        (lambda: geodisk.verify(SAMPLES, avoid=(SAMPLES, 0)), ValueError, "point 0 has the radius 0"),
        (
            lambda: geodisk.verify(SAMPLES, avoid=(([9**6], [[1, 0, 0]]), 1)),
            ValueError,
            "point 0 is in face 531441",
        ),
        (lambda: geodisk.verify(geodisk.Samples([[0, 0]])), ValueError, "do not know their mesh"),
        (
            lambda: geodisk.verify(geodisk.Samples([[0, 0]], extents=(1, 1))),
            ValueError,
            "give min_distance",
        ),
        (lambda: geodisk.verify(HEAVY), ValueError, "weights"),
        (
            lambda: geodisk.verify(geodisk.sample_box(min_distance=0.2), VERTICES, FACES),
            ValueError,
            "no mesh",
        ),
        (lambda: geodisk.transfer(SAMPLES, VERTICES[:-1]), geodisk.MeshRejected, "vertex 799"),
        (lambda: geodisk.transfer(SAMPLES, VERTICES.ravel()), ValueError, "shape"),
        (lambda: geodisk.transfer(SAMPLES, geodisk.Mesh(*TETRAHEDRON)), ValueError, "pose: has 4"),
        (lambda: geodisk.transfer(SAMPLES, VERTICES, VERTICES + 1, FACES), ValueError, "another mesh"),
        (lambda: geodisk.transfer(geodisk.sample_box(count=9), VERTICES), ValueError, "box"),
        (lambda: geodisk.render(SAMPLES, VERTICES * 2, FACES), ValueError, "another mesh"),
        (lambda: geodisk.render(SAMPLES, style="oil"), ValueError, "is none of auto"),
        (lambda: geodisk.render(SAMPLES, view="above"), ValueError, "view takes"),
        (lambda: geodisk.render(SAMPLES, size=(16, 15)), ValueError, "size is 15, not from 16 to 16384"),
        (lambda: geodisk.render(SAMPLES, size=(0, 1)), ValueError, "size is 0, not from 16 to 16384"),
        (lambda: geodisk.render(SAMPLES, size=(20, 20), legend=True), ValueError, "does not fit"),
        (lambda: geodisk.render(SAMPLES, device="nowhere"), geodisk.NoDevice, "nowhere"),
    ],
)
def test_bad_arguments(call, kind, text):
    with pytest.raises(kind, match=text):
        call()


def test_arrays_that_changed_are_noticed():
    points, vertices = SAMPLES.points.copy(), VERTICES.copy()
    samples = geodisk.sample(vertices, FACES, min_distance=0.5)
    vertices[:] *= 2
    assert not geodisk.verify(samples)
    damaged = dataclasses.replace(SAMPLES, points=points)
    points[3, 0] = np.nan
    with pytest.raises(geodisk.InvalidArgument, match=r"points\[3, 0\] is nan"):
        geodisk.verify(damaged)


def test_threads():
    expected = geodisk.verify(SAMPLES).smallest
    found = []
    threads = [
        threading.Thread(target=lambda: found.append(geodisk.verify(SAMPLES).smallest))
        for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [expected] * 4


def test_interruption():
    # A thousand disks that each cover 90,000 faces take minutes.
    vertices, faces = torus(300, 150)
    places = np.arange(0, len(faces), len(faces) // 1000)
    mesh = geodisk.Mesh(vertices, faces)
    many = geodisk.Samples(
        vertices[faces[places]].mean(axis=1),
        face_index=places,
        barycentric=np.full((len(places), 3), 1 / 3),
        min_distance=9,
    )
    timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        geodisk.verify(many, mesh)
    timer.join()
