"""Files of samples: what is written is read again, and what is broken says so."""

import io
import os
import subprocess
import threading
import zipfile

import numpy as np
import pytest

import geodisk
from meshes import FACES, LENGTHS, TETRAHEDRON, VERTICES

FORMATS = ["npz", "csv", "ply"]
ARRAYS = ["points", "normals", "face_index", "barycentric", "radius", "order"]


def equal(a, b):
    for name in ARRAYS:
        one, other = getattr(a, name), getattr(b, name)
        assert (one is None) == (other is None), name
        assert one is None or (one.dtype == other.dtype and np.array_equal(one, other)), name
    same = (a.min_distance, a.seed, a.extents, a.periodic)
    return same == (b.min_distance, b.seed, b.extents, b.periodic)


SETS = {
    "mesh": geodisk.sample(VERTICES, FACES, min_distance=0.5, seed=2**64 - 1),
    "radii": geodisk.sample(
        VERTICES, FACES, min_distance=0.6, radius_factor=np.linspace(0.3, 1, len(VERTICES))
    ),
    "plane": geodisk.sample([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]], min_distance=0.1),
    "space": geodisk.sample(np.hstack([VERTICES, VERTICES]), FACES, min_distance=0.9),
    "lengths": geodisk.sample(len(VERTICES), FACES, edge_lengths=LENGTHS, min_distance=0.5),
    "interval": geodisk.sample_box([0.3], min_distance=0.01),
    "square": geodisk.sample_box([1, 1 / 3], min_distance=0.1, periodic=True),
    "box": geodisk.sample_box([1, 2, 0.7], min_distance=0.3),
    "cube": geodisk.sample_box([1] * 5, min_distance=0.7),
    "doubles": geodisk.Samples(
        [[0.1, 1e300, -3]], face_index=[4], barycentric=[[0.1, 0.2, 0.7]], min_distance=0.1
    ),
    "unknown": geodisk.Samples(np.zeros((2, 3)), face_index=[0, 1], barycentric=np.eye(3)[:2]),
    "none": geodisk.Samples(
        np.zeros((0, 3)), face_index=[], barycentric=np.zeros((0, 3)), min_distance=1
    ),
}


@pytest.mark.parametrize("kind", FORMATS)
@pytest.mark.parametrize("name", SETS)
def test_what_is_saved_is_read_again(tmp_path, name, kind):
    path = tmp_path / f"a.{kind}"
    samples = SETS[name]
    samples.save(path)
    again = geodisk.read(path)
    if np.isnan(samples.min_distance):
        assert np.isnan(again.min_distance) and np.isnan(again.radius).all()
        assert np.array_equal(again.face_index, samples.face_index)
    else:
        assert equal(again, samples)
    assert os.listdir(tmp_path) == [path.name]


@pytest.mark.parametrize("kind", FORMATS)
def test_radii_that_are_alike_but_not_half_the_distance_stay(tmp_path, kind):
    vertices, faces = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float), [[0, 1, 2]]
    samples = geodisk.sample(vertices, faces, min_distance=0.4, radius_factor=np.full(3, 0.5))
    assert len(samples) > 10 and geodisk.verify(samples).ok
    samples.save(tmp_path / f"a.{kind}")
    again = geodisk.read(tmp_path / f"a.{kind}")
    assert np.allclose(again.radius, 0.1) and again.min_distance == 0.4
    assert geodisk.verify(again, vertices, faces).ok
    assert not geodisk.verify(samples, min_distance=0.4).ok


@pytest.mark.skipif("GEODISK_COMMAND" not in os.environ, reason="needs the program")
def test_files_of_the_program_are_read(tmp_path):
    def program(*arguments):
        subprocess.run([os.environ["GEODISK_COMMAND"], *arguments, "-q"], cwd=tmp_path, check=True)

    mesh = "builtin:torus-knot:8"
    program("sample", mesh, "-o", "a.csv", "-d", "20%", "--seed", "7")
    first = geodisk.read(tmp_path / "a.csv")
    assert len(first) > 5 and first.seed == 7 and first.min_distance > 0
    for output in (["b.npz"], ["b.ply"], ["c.ply", "--ascii"]):
        program("transfer", "a.csv", mesh, mesh, "-o", *output)
        samples = geodisk.read(tmp_path / output[0])
        assert samples.min_distance >= first.min_distance and samples.seed is None
        assert np.array_equal(samples.face_index, first.face_index)
        assert np.allclose(samples.barycentric, first.barycentric, rtol=1e-6)
        assert np.allclose(samples.points, first.points, rtol=1e-5)
        assert np.allclose(samples.normals, first.normals, rtol=1e-5, atol=1e-5)
    for name in ("d.npz", "d.ply"):
        program("box", "--extents", "1,2", "-d", "0.2", "--periodic", "-o", name)
        samples = geodisk.read(tmp_path / name)
        assert samples.extents == (1, 2) and samples.periodic and samples.points.shape[1] == 2


@pytest.mark.parametrize("kind", FORMATS)
def test_what_is_cut_off_or_damaged_says_so(tmp_path, kind):
    path = tmp_path / f"a.{kind}"
    geodisk.sample(*TETRAHEDRON, min_distance=1, stop_count=2).save(path)
    whole = path.read_bytes()
    bad = [whole[:n] for n in range(0, len(whole), 1 if kind != "npz" else 7)]
    bad += [b"\0" * 1000, b"\xff" * 1000, b"\n" * 9, bytes(range(256)) * 9]
    refused = 0
    for data in bad:
        path.write_bytes(data)
        try:
            geodisk.read(path)
        except geodisk.InvalidArgument as error:
            assert str(error).startswith(f"{path}: ") and len(str(error)) > len(f"{path}: ")
            refused += 1
    # Text that ends with a line may have been all.
    assert refused == len(bad) or (kind == "csv" and refused >= len(bad) - 3)
    generator = np.random.default_rng(1)
    for _ in range(100):  # Bytes of any value anywhere: samples or an error, and nothing else.
        data = bytearray(whole)
        data[generator.integers(len(data))] = generator.integers(256)
        path.write_bytes(data)
        try:
            assert isinstance(geodisk.read(path), geodisk.Samples)
        except geodisk.InvalidArgument:
            pass


def archive(**arrays):
    file = io.BytesIO()
    np.savez(file, **arrays)
    return file.getvalue()


@pytest.mark.parametrize(
    "name, data, text",
    [
        ("a.npz", archive(points=np.zeros((2, 3))), "neither face_index nor a box"),
        ("a.npz", archive(face_index=np.array([object()])), "pickle"),
        ("a.npz", archive(face_index=np.zeros(2, int)), "barycentric"),
        ("a.npz", archive(face_index=[0.5], barycentric=np.ones((1, 3))), "integers"),
        ("a.npz", archive(face_index=[0], barycentric=np.ones((2, 3))), "shape"),
        ("a.npz", archive(face_index=[0], barycentric=[[np.nan, 0, 0]]), "nan"),
        ("a.npz", archive(face_index=[-1], barycentric=[[1, 0, 0]]), "is -1"),
        ("a.npz", b"no archive", "not a numpy archive"),
        ("a.csv", b"x,y,z\n1,2,3\n", "neither face_index nor a box"),
        ("a.csv", b"face_index,bary_u,bary_v,bary_w\n0,1,0\n", "3 columns"),
        ("a.csv", b"# samples: 2\nface_index,bary_u,bary_v,bary_w\n0,1,0,0\n", "header says 2"),
        ("a.csv", b"face_index,bary_u,bary_v,bary_w\n0.5,1,0,0\n", "not whole"),
        ("a.csv", b"face_index,bary_u,bary_v,bary_w\nnan,1,0,0\n", "not whole"),
        ("a.csv", b"face_index,bary_u,bary_v,bary_w\n0,1,0,x\n", "'x'"),
        ("a.csv", b"# box: 1 x up\nx,y\n1,2\n", "'up'"),
        ("a.csv", b"# min_distance: -1\nface_index,bary_u,bary_v,bary_w\n0,1,0,0\n", "positive"),
        ("a.ply", b"ply\nformat ascii 1.0\nelement face 1\n", "element face"),
        ("a.ply", b"ply\nformat ascii 1.0\nelement vertex 0\nend_header\n", "properties"),
        (
            "a.ply",
            b"ply\nformat ascii 1.0\nelement vertex -1\nproperty int x\nend_header\n",
            "-1 samples",
        ),
        (
            "a.ply",
            b"ply\nformat binary_little_endian 1.0\nelement vertex 99999999999999\n"
            b"property double x\nend_header\n0123",
            "4 bytes",
        ),
        ("a.xyz", b"1 2 3\n", "npz"),
    ],
)
def test_what_is_no_file_of_samples_says_so(tmp_path, name, data, text):
    (tmp_path / name).write_bytes(data)
    with pytest.raises(geodisk.InvalidArgument) as caught:
        geodisk.read(tmp_path / name)
    path, _, cause = str(caught.value).partition(": ")
    assert path == str(tmp_path / name) and text in cause


@pytest.mark.parametrize(
    "error, kind",
    [
        (MemoryError(), MemoryError),
        (OSError(5, "Input/output error"), OSError),
        (OSError(22, "Invalid argument"), geodisk.InvalidArgument),  # An offset before the file.
        (OSError("not a gzipped file"), geodisk.InvalidArgument),
    ],
)
def test_only_what_is_wrong_with_a_file_is_said_of_it(error, kind, tmp_path, monkeypatch):
    def load(*_, **__):
        raise error

    SETS["mesh"].save(tmp_path / "a.npz")
    monkeypatch.setattr(np, "load", load)
    with pytest.raises(kind) as caught:
        geodisk.read(tmp_path / "a.npz")
    assert (caught.value is error) == (kind is not geodisk.InvalidArgument)


def test_what_cannot_be_opened_or_written(tmp_path):
    samples = SETS["mesh"]
    with pytest.raises(FileNotFoundError, match="nowhere.npz"):
        geodisk.read(tmp_path / "nowhere.npz")
    with pytest.raises(OSError):
        (tmp_path / "folder.npz").mkdir()
        geodisk.read(tmp_path / "folder.npz")
    with pytest.raises(ValueError, match="npz"):
        samples.save(tmp_path / "a.doc")
    with pytest.raises(OSError):
        samples.save(tmp_path / "nowhere" / "a.npz")
    assert os.listdir(tmp_path) == ["folder.npz"]
    with zipfile.ZipFile(tmp_path / "a.npz", "w") as file:  # Numpy knows other members as bytes.
        file.writestr("face_index", b"text")
    with pytest.raises(geodisk.InvalidArgument, match="a.npz"):
        geodisk.read(tmp_path / "a.npz")


def test_saving_keeps_links_and_permissions(tmp_path):
    few, many = SETS["square"], SETS["mesh"]
    path = tmp_path / "a.npz"
    few.save(path)
    assert path.stat().st_mode & 0o777 == 0o666 & ~_umask()
    path.chmod(0o640)
    link = tmp_path / "link.npz"
    link.symlink_to("a.npz")
    many.save(link)
    assert link.is_symlink() and path.stat().st_mode & 0o777 == 0o640
    assert equal(geodisk.read(path), many)
    dangling = tmp_path / "dangling.npz"
    dangling.symlink_to("new.npz")
    few.save(dangling)
    assert dangling.is_symlink() and equal(geodisk.read(tmp_path / "new.npz"), few)
    os.link(path, tmp_path / "other.npz")
    with pytest.raises(OSError, match="another name"):
        few.save(path)
    pipe = tmp_path / "pipe.npz"
    os.mkfifo(pipe)
    with pytest.raises(OSError, match="not a regular file"):
        few.save(pipe)
    assert equal(geodisk.read(path), many)  # It stays as it was.
    assert not [name for name in os.listdir(tmp_path) if name.endswith(".tmp")]


def _umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


def test_threads_save_whole_files(tmp_path):
    sets = [SETS["mesh"], SETS["square"]]
    for name in ("a.ply", "a.npz"):
        failed = []

        def save(samples):
            try:
                for _ in range(10):
                    samples.save(tmp_path / name)
            except OSError as error:
                failed.append(error)

        threads = [threading.Thread(target=save, args=(samples,)) for samples in sets * 2]
        for thread in threads:
            thread.start()
        while any(thread.is_alive() for thread in threads):
            if (tmp_path / name).exists():
                assert len(geodisk.read(tmp_path / name)) in map(len, sets)
        assert not failed
    assert sorted(os.listdir(tmp_path)) == ["a.npz", "a.ply"]


@pytest.mark.parametrize(
    "arrays, kind, text",
    [
        ({}, ValueError, "points"),
        ({"points": [[1, 2, 3]], "face_index": [0]}, ValueError, "barycentric"),
        ({"points": [1, 2, 3]}, ValueError, "shape"),
        ({"points": np.zeros((2, 9))}, ValueError, "shape"),
        ({"points": [[1j, 2, 3]]}, TypeError, "complex"),
        ({"points": [["a", "b", "c"]]}, TypeError, "real numbers"),
        ({"points": [[np.inf, 2, 3]]}, ValueError, r"points\[0, 0\] is inf"),
        ({"points": [[1, 2, 3]], "normals": [[1, 2]]}, ValueError, "normals"),
        ({"points": [[1, 2, 3]], "radius": [1, 2]}, ValueError, "radius"),
        ({"points": [[1, 2, 3]], "radius": [-1]}, ValueError, "radius"),
        ({"points": [[1, 2, 3]], "order": [1, 2]}, ValueError, "order"),
        ({"points": [[1, 2, 3]], "min_distance": -1}, ValueError, "positive"),
        ({"points": [[1, 2, 3]], "extents": (1, 2)}, ValueError, "extents"),
        ({"points": [[1, 2, 3]], "extents": (1, 2, 0)}, ValueError, "extents"),
    ],
)
def test_bad_samples(arrays, kind, text):
    with pytest.raises(kind, match=text):
        geodisk.Samples(**arrays)
