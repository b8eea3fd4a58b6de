"""Samples that follow edits are those of whole runs."""

import dataclasses
import pickle
import warnings

import numpy as np
import pytest

import geodisk
from meshes import FACES, SOUP, VERTICES, same, torus
from test_attributes import write_png

SAMPLES = geodisk.sample(VERTICES, FACES, min_distance=0.3, seed=5)
MASK = np.arange(len(FACES)) % 3 != 0


def moved():
    edited = VERTICES * 1.0
    edited[0] *= 1.1
    return edited


def whole(vertices=VERTICES, **options):
    return geodisk.sample(vertices, FACES, min_distance=0.3, seed=5, **options)


def test_vertices_that_move():
    there = geodisk.update(SAMPLES, moved())
    assert same(there, whole(moved())) and np.array_equal(there.points, whole(moved()).points)
    assert there.seed == 5 and there.min_distance == 0.3
    assert there.report["update"]["rounds"] > 0
    same_mesh = geodisk.update(SAMPLES, VERTICES)
    assert np.array_equal(same_mesh.points, SAMPLES.points)
    assert same_mesh.report["update"] == dict(rounds=0, faces=0, uploaded=0, removed=0, added=0)
    again = geodisk.update(there, VERTICES)
    assert np.array_equal(again.points, SAMPLES.points)
    soup = geodisk.sample(*SOUP, min_distance=0.5, weld=True)
    assert same(geodisk.update(soup, SOUP[0]), soup)


def test_samples_of_files_need_their_mesh(tmp_path):
    SAMPLES.save(tmp_path / "a.ply")
    read = geodisk.read(tmp_path / "a.ply")
    with pytest.raises(geodisk.InvalidArgument, match="mesh"):
        geodisk.update(read, moved())
    there = geodisk.update(read, moved(), vertices=VERTICES, faces=FACES)
    assert same(there, whole(moved()))


def test_samples_know_the_frame_that_decided_them(tmp_path):
    flap = np.concatenate([FACES, [[0, FACES[0, 1], 9]]])
    edits = [(VERTICES * [1, 1, 3], FACES), (VERTICES, flap)]
    assert SAMPLES._frame is None
    for vertices, faces in edits:
        there = geodisk.update(SAMPLES, vertices, faces)
        assert there.report["update"]["faces"] == len(faces)
        assert same(there, geodisk.sample(vertices, faces, min_distance=0.3, seed=5))
        for suffix in ("ply", "csv", "npz"):
            there.save(tmp_path / f"there.{suffix}")
            read = geodisk.read(tmp_path / f"there.{suffix}")
            assert read._frame == there._frame
            back = geodisk.update(read, VERTICES, FACES, vertices=vertices, faces=faces)
            assert same(back, SAMPLES) and back.report["update"]["rounds"] > 0
        assert pickle.loads(pickle.dumps(there))._frame == there._frame
    wrong = dataclasses.replace(read, _frame=geodisk._job.JobFrame("47zz"))
    with pytest.raises(geodisk.InvalidArgument, match="wrong job_frame"):
        geodisk.update(wrong, VERTICES, FACES, vertices=vertices, faces=faces)


def test_masks_and_existing_samples():
    masked = whole(face_mask=MASK)
    assert same(geodisk.update(SAMPLES, face_mask=MASK), masked)
    assert same(geodisk.update(masked, face_mask=np.ones(len(FACES), bool)), SAMPLES)
    assert same(geodisk.update(masked, moved()), whole(moved(), face_mask=MASK))
    given = ([3, 70], [[0.25, 0.5, 0.25], [0.5, 0.25, 0.25]])
    kept = whole(existing=given)
    there = geodisk.update(SAMPLES, existing=given)
    assert same(there, kept) and there.columns["existing"].sum() == 2
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # The column "existing" is not missed.
        assert same(geodisk.update(there, existing=([], [])), SAMPLES)
    assert same(geodisk.update(kept, moved()), whole(moved(), existing=given))
    own = whole(existing=SAMPLES[:2])
    assert np.array_equal(geodisk.update(own, moved()).face_index[:2], own.face_index[:2])


def test_points_to_avoid():
    avoid = (SAMPLES[:2], [0.9, 0.2])
    clear = whole(avoid=avoid)
    assert same(geodisk.update(SAMPLES, avoid=avoid), clear) and not same(clear, SAMPLES)
    places = SAMPLES.face_index[:2], SAMPLES.barycentric[:2]
    there = geodisk.update(clear, moved())
    assert same(there, whole(moved(), avoid=(places, avoid[1])))
    assert same(geodisk.update(there, VERTICES, avoid=(([], []), 1)), SAMPLES)
    assert there.report["options"] == ["avoid"]


def test_radii_and_pools(tmp_path):
    factors = 0.6 + 0.4 * (VERTICES[:, 0] > 0)
    varied = whole(radius_factor=factors)
    painted = factors.copy()
    painted[:3] = 0.5
    assert same(geodisk.update(varied, radius_factor=painted), whole(radius_factor=painted))
    assert same(geodisk.update(varied, moved()), whole(moved(), radius_factor=factors))
    density = 1 + 3.0 * (VERTICES[:, 0] > 0)
    dense = geodisk.sample(VERTICES, FACES, count=400, seed=5, density=density)
    painted = density.copy()
    painted[:3] = 2
    there = geodisk.update(dense, density=painted)
    assert there.min_distance == dense.min_distance
    same_distance = geodisk.sample(
        VERTICES, FACES, min_distance=dense.min_distance, seed=5, density=painted
    )
    assert same(there, same_distance)
    sparse = whole(pool_ratio=5)
    assert same(geodisk.update(sparse, moved()), whole(moved(), pool_ratio=5))
    sparse.save(tmp_path / "sparse.csv")
    surface = {"vertices": VERTICES, "faces": FACES}
    for other in (geodisk.read(tmp_path / "sparse.csv"), pickle.loads(pickle.dumps(sparse))):
        assert same(geodisk.update(other, moved(), **surface), whole(moved(), pool_ratio=5))


def test_keys_find_faces_that_are_elsewhere():
    keys = np.arange(len(FACES)) + 7
    keyed = whole(face_keys=keys)
    turned = np.ascontiguousarray(np.asarray(FACES)[::-1])
    there = geodisk.update(keyed, VERTICES, turned, face_keys=keys[::-1])
    expected = geodisk.sample(
        VERTICES, turned, min_distance=0.3, seed=5, face_keys=keys[::-1]
    )
    assert same(there, expected)
    assert there.report["update"]["rounds"] == 0


def test_what_the_samples_were_made_with_must_fit_other_faces():
    place = ([3], [[0.25, 0.5, 0.25]])
    for name, value, what in [
        ("face_mask", MASK, "faces"),
        ("face_mask", np.flatnonzero(MASK), "faces"),
        ("face_keys", np.arange(len(FACES)), "faces"),
        ("existing", place, "faces"),
        ("avoid", (place, 0.5), "faces"),
        ("radius_factor", np.full(len(VERTICES), 0.9), "vertices"),
    ]:
        made = whole(**{name: value})
        for to in (torus(9, 9), torus(42, 20)):
            with pytest.raises(geodisk.InvalidArgument, match=f"{name}.* other {what}; give {name}"):
                geodisk.update(made, *to)
    turned = np.asarray(FACES)[::-1].copy()
    with pytest.raises(geodisk.InvalidArgument, match="other faces; give face_mask"):
        geodisk.update(whole(face_mask=MASK), VERTICES, turned)
    there = geodisk.update(whole(face_mask=MASK), VERTICES, turned, face_mask=MASK[::-1])
    assert MASK[::-1][there.face_index].all()


ROOF = (  # With normals that are not those of its faces.
    "v 0 0 0\nv 1 0 1\nv 1 1 1\nv 0 1 0\nv 2 0 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "vn 0 0 1\nvn 1 0 1\nusemtl a\nf 1/1/1 2/2/1 3/3/1 4/4/1\nusemtl b\nf 2/1/2 5/2/2 6/3/2 3/4/2\n"
)


@pytest.fixture
def roof(tmp_path):
    """Paths of a mesh, of an edited one, and of an image."""
    paths = tmp_path / "roof.obj", tmp_path / "moved.obj", tmp_path / "ramp.png"
    paths[0].write_text(ROOF)
    paths[1].write_text(ROOF.replace("v 1 1 1\n", "v 1 1 1.1\n"))
    write_png(paths[2], np.arange(48, dtype=np.uint8).reshape(4, 4, 3) * 5)
    return paths


def equal(a, b):
    assert same(a, b) and list(a.attributes) == list(b.attributes)
    assert np.array_equal(a.normals, b.normals) and np.array_equal(a.points, b.points)
    for name, values in b.attributes.items():
        assert np.array_equal(a.attributes[name], values), name
    assert a.columns.keys() == b.columns.keys()
    for name, column in b.columns.items():
        assert np.array_equal(a.columns[name], column), name


@pytest.mark.filterwarnings("error::geodisk.GeodiskWarning")
@pytest.mark.parametrize("normals", ["face", "smooth", "file"])
def test_updates_keep_normals_frames_colours_and_attributes(roof, normals):
    record = dict(
        min_distance=0.2, seed=4, texture=roof[2], frames=True, attributes=["uv"], normals=normals
    )
    before, after = geodisk.sample(roof[0], **record), geodisk.sample(roof[1], **record)
    equal(geodisk.update(before, roof[1]), after)
    equal(geodisk.update(geodisk.update(before, roof[1]), roof[0]), before)
    chosen = before.points[:, 0] < 1
    mask = np.array([True, True, False, False])
    masked = geodisk.sample(roof[0], **record, face_mask=mask)
    equal(geodisk.update(before, face_mask=mask), masked)
    assert len(masked) < len(chosen)
    given = dict(texture=roof[2], frames=True, attributes=["uv"], normals=normals)
    plain = geodisk.sample(roof[0], min_distance=0.2, seed=4)
    equal(geodisk.update(plain, roof[1], **given), after)
    less = geodisk.update(before, roof[1], normals="face", frames=False, attributes=())
    assert list(less.attributes) == ["color"]


@pytest.mark.filterwarnings("error::geodisk.GeodiskWarning")
def test_moved_vertices_keep_what_the_faces_have(roof):
    mesh = geodisk.Mesh(roof[0], attributes=["uv"], columns=["material"])
    before = geodisk.sample(mesh, min_distance=0.2, seed=4, normals="smooth", frames=True)
    moved = geodisk.Mesh(roof[1], attributes=["uv"], columns=["material"])
    after = geodisk.sample(moved, min_distance=0.2, seed=4, normals="smooth", frames=True)
    equal(geodisk.update(before, moved.vertices), after)
    assert set(after.columns["material"]) == {0, 1}
    coloured = dict(min_distance=0.2, seed=4, texture=roof[2])
    there = geodisk.update(geodisk.sample(roof[0], **coloured), moved.vertices)
    equal(there, geodisk.sample(roof[1], **coloured))
    equal(geodisk.update(there, mesh.vertices), geodisk.sample(roof[0], **coloured))
    # Polygons keep their numbers, so that a mask may go by them.
    there = geodisk.update(before, moved.vertices, face_mask=[False, True])
    assert set(there.polygon_index) == {1}


def test_what_updates_cannot_keep_is_warned_of(roof):
    own = geodisk.sample(roof[0], min_distance=0.2, seed=4)
    own.attributes["own"] = np.arange(len(own))
    with pytest.warns(geodisk.GeodiskWarning, match=r"lack attributes\['own'\]") as told:
        assert same(geodisk.update(own, roof[1]), geodisk.sample(roof[1], min_distance=0.2, seed=4))
    assert [(one.message.kind, one.message.count) for one in told] == [("not_kept", 1)]
    assert told[0].filename == __file__
    before = geodisk.sample(roof[0], min_distance=0.2, seed=4, normals="file", attributes=["uv"])
    vertices = geodisk.Mesh(roof[1]).vertices
    with pytest.warns(geodisk.GeodiskWarning, match=r"lack normals='file' of"):
        there = geodisk.update(before, vertices)
    assert "uv" in there.attributes
    with pytest.warns(geodisk.GeodiskWarning, match=r"lack attributes\['uv'\], normals='file'"):
        geodisk.update(before, geodisk.Mesh(roof[1]))
    with pytest.raises(geodisk.InvalidArgument, match="has no attribute 'color'"):
        geodisk.update(before, attributes=["color"])


def test_samples_of_files_know_their_normals(roof, tmp_path):
    before = geodisk.sample(roof[0], min_distance=0.2, seed=4, normals="smooth", frames=True)
    after = geodisk.sample(roof[1], min_distance=0.2, seed=4, normals="smooth", frames=True)
    for kind in ("npz", "csv", "ply"):
        before.save(tmp_path / f"a.{kind}")
        read = geodisk.read(tmp_path / f"a.{kind}")
        assert read.attributes.keys() == {"frames"}
        equal(geodisk.update(read, roof[1], vertices=roof[0]), after)
        equal(geodisk.transfer(read, roof[0], roof[0]), geodisk.transfer(before, roof[0]))
    equal(geodisk.update(pickle.loads(pickle.dumps(before)), roof[1], vertices=roof[0]), after)


def test_transfers_keep_normals_and_frames(roof):
    for normals in ("face", "smooth", "file"):
        record = dict(normals=normals, frames=True)
        before = geodisk.sample(roof[0], min_distance=0.2, seed=4, **record)
        plain = geodisk.sample(roof[0], min_distance=0.2, seed=4)
        equal(geodisk.transfer(before, roof[1]), geodisk.transfer(plain, roof[1], **record))
    with pytest.warns(geodisk.GeodiskWarning, match=r"lack normals='file' of"):
        there = geodisk.transfer(before, geodisk.Mesh(roof[1]).vertices)
    equal(there, geodisk.transfer(plain, roof[1], frames=True))
    with pytest.raises(geodisk.InvalidArgument, match="made with transfer cannot be updated"):
        geodisk.update(there, roof[1])


def test_removed_existing_samples_and_points_are_no_longer_told_of():
    given = geodisk.sample(VERTICES, FACES, min_distance=0.3, seed=5, existing=SAMPLES[:3])
    for samples in (SAMPLES, given):
        there = geodisk.update(samples, existing=([], []), avoid=([], 0.5))
        assert there.report["options"] == []
        assert same(there, geodisk.sample(VERTICES, FACES, min_distance=0.3, seed=5))


@pytest.mark.filterwarnings("ignore::geodisk.MeshWarning")
def test_what_cannot_be_updated_is_refused(tmp_path):
    def refused(match, samples=SAMPLES, *arguments, kind=geodisk.InvalidArgument, **options):
        with pytest.raises(kind, match=match):
            geodisk.update(samples, *arguments, **options)

    edited = moved()
    refused("is no candidate", dataclasses.replace(SAMPLES, seed=6), edited)
    refused("do not know their seed", dataclasses.replace(SAMPLES, seed=None), edited)
    refused("removed, added or changed", SAMPLES[::2], edited)
    refused("removed, added or changed", SAMPLES[[0, *range(len(SAMPLES) - 1)]], edited)
    assert same(geodisk.update(SAMPLES[::-1], edited), whole(edited))
    refused("made with stop_count cannot", whole(stop_count=20), edited)
    many = geodisk.sample_many([(VERTICES, FACES)], min_distance=0.3)
    assert same(geodisk.update(many[0], edited), geodisk.sample(edited, FACES, min_distance=0.3))
    SAMPLES.save(tmp_path / "other.csv")
    text = (tmp_path / "other.csv").read_text().replace("sampling_version: 1\n", "sampling_version: 7\n")
    (tmp_path / "other.csv").write_text(text)
    refused(
        "made with sampling_version=7 cannot",
        geodisk.read(tmp_path / "other.csv"),
        VERTICES,
        FACES,
        vertices=VERTICES,
        faces=FACES,
    )
    refused("not made 0.2 apart", dataclasses.replace(SAMPLES, min_distance=0.2), edited)
    refused("made with maximal cannot", whole(maximal=True), edited)
    refused("made without density and radius_factor, so radius_factor changes all", SAMPLES,
            radius_factor=np.full(len(VERTICES), 0.5))
    refused("not from 0.001 to 1|below 0.001|nan", whole(radius_factor=np.ones(len(VERTICES))),
            radius_factor=np.full(len(VERTICES), np.nan))
    refused("none of", kind=TypeError, before={"seed": 1})
    refused("to_faces", kind=TypeError, to_faces=FACES)
    refused("no mesh", geodisk.sample_box([1, 1], min_distance=0.2))
    refused("the minimum distance is too small for this mesh", SAMPLES, VERTICES * [1, 1, 1e5])
    density = 1 + (VERTICES[:, 0] > 0)
    refused("another largest or least value", whole(density=density), density=density**2)
    refused("with density, so radius_factor changes", whole(density=density), radius_factor=density)
    refused("before is 3, not a dict", kind=TypeError, before=3)
    refused("pool_ratio is 'a'", kind=TypeError, before={"pool_ratio": "a"})
    other = torus(9, 9)
    refused("face|mesh", SAMPLES, edited, vertices=other[0], faces=other[1])
    with pytest.raises(geodisk.Cancelled):
        geodisk.update(SAMPLES, edited, progress=lambda part, count: False)


@pytest.mark.parametrize("made, told", [(20, 40), (40, 20), (40, 60)])
def test_another_pool_ratio_than_that_of_the_samples_is_refused(made, told, tmp_path):
    edited, of_mesh = moved(), {"vertices": VERTICES, "faces": FACES}
    samples = whole(pool_ratio=made)
    samples.save(tmp_path / "samples.csv")
    read = geodisk.read(tmp_path / "samples.csv")
    for those, mesh in ((samples, {}), (read, of_mesh)):
        with pytest.raises(geodisk.InvalidArgument, match=f"with the pool_ratio {made}, not {told}"):
            geodisk.update(those, edited, before={"pool_ratio": told}, **mesh)
    assert same(geodisk.update(read, edited, **of_mesh), whole(edited, pool_ratio=made))


@pytest.mark.parametrize("ratio", ["nan", "many", "0"])
def test_a_wrong_pool_ratio_of_a_file_is_refused(ratio, tmp_path):
    whole(pool_ratio=40).save(tmp_path / "a.csv")
    text = (tmp_path / "a.csv").read_text().replace("pool_ratio: 40", f"pool_ratio: {ratio}")
    (tmp_path / "a.csv").write_text(text)
    read = geodisk.read(tmp_path / "a.csv")
    for before in (None, {"pool_ratio": 40}):
        with pytest.raises(geodisk.InvalidArgument, match="wrong pool_ratio"):
            geodisk.update(read, moved(), vertices=VERTICES, faces=FACES, before=before)


@pytest.mark.filterwarnings("ignore::geodisk.MeshWarning")
def test_samples_of_a_mesh_joined_in_another_way_are_refused(tmp_path):
    # Two squares that share a side, whose vertices are there twice.
    seam = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [1, 0, 0], [2, 0, 0], [2, 1, 0], [1, 1, 0]], float)
    faces = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]
    edited = seam * 1.0
    edited[0, 2] = 0.1
    for made, other in ((True, False), (False, True)):
        samples = geodisk.sample(seam, faces, min_distance=0.15, keep_seams=made)
        samples.save(tmp_path / "a.csv")
        read = geodisk.read(tmp_path / "a.csv")
        with pytest.raises(geodisk.InvalidArgument, match="made with.* keep_seams"):
            geodisk.update(read, edited, vertices=seam, faces=faces, keep_seams=other)
        there = geodisk.update(read, edited, vertices=seam, faces=faces, keep_seams=made)
        assert same(there, geodisk.sample(edited, faces, min_distance=0.15, keep_seams=made))


@pytest.mark.filterwarnings("ignore::geodisk.MeshWarning")
def test_meshes_of_files_are_welded_again(tmp_path):
    def write(name, points):
        rows = [f"v {x} {y} {z}" for x, y, z in points.tolist()]
        rows += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
        (tmp_path / name).write_text("\n".join(rows) + "\n")
        return str(tmp_path / name)

    # Two squares a thousandth apart.
    gap = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [1, 0, 1e-3], [2, 0, 0], [2, 1, 0], [1, 1, 1e-3]], float)
    faces = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]
    edited = gap * 1.0
    edited[0, 2] = 0.1
    before, after = write("a.obj", gap), write("b.obj", edited)
    wanted = geodisk.sample(edited, faces, min_distance=0.15, weld=0.01)
    samples = geodisk.sample(before, min_distance=0.15, weld=0.01)
    assert same(geodisk.update(samples, gap), samples)
    samples.save(tmp_path / "a.csv")
    read = geodisk.read(tmp_path / "a.csv")
    for there in (
        geodisk.update(samples, edited),
        geodisk.update(samples, after),
        geodisk.update(read, after, vertices=before, weld=0.01),
    ):
        assert same(there, wanted) and there._told["weld"] == "0.01"
        assert geodisk.verify(there).ok
    with pytest.raises(geodisk.InvalidArgument, match="made with weld=0.01"):
        geodisk.update(read, after, vertices=before)


def test_samples_of_a_file_need_all_parameters_that_made_them(tmp_path):
    density = 1 + (VERTICES[:, 0] > 0)
    mask = VERTICES[FACES].mean(axis=1)[:, 2] > 0
    whole(density=density, face_mask=mask).save(tmp_path / "samples.npz")
    read = geodisk.read(tmp_path / "samples.npz")
    of_mesh = {"vertices": VERTICES, "faces": FACES}
    for before in (None, {"density": density}):
        with pytest.raises(geodisk.InvalidArgument, match="made with .*face_mask, and do not know"):
            geodisk.update(read, moved(), before=before, **of_mesh)
    there = geodisk.update(read, moved(), before={"density": density, "face_mask": mask}, **of_mesh)
    assert same(there, whole(moved(), density=density, face_mask=mask))


def test_samples_of_a_file_tell_which_mask_they_were_made_with(tmp_path):
    all_faces = np.ones(len(FACES), bool)
    mask = np.arange(len(FACES)) < len(FACES) // 2
    geodisk.sample(VERTICES, FACES, min_distance=0.3, face_mask=mask).save(tmp_path / "a.csv")
    samples = geodisk.read(tmp_path / "a.csv")
    mesh = geodisk.Mesh(VERTICES, FACES)
    with pytest.raises(geodisk.InvalidArgument, match="made with another face_mask"):
        geodisk.update(samples, vertices=mesh, before={"face_mask": all_faces})
    wider = geodisk.update(samples, vertices=mesh, before={"face_mask": mask}, face_mask=all_faces)
    wider.save(tmp_path / "b.csv")
    again = geodisk.read(tmp_path / "b.csv")
    kept = geodisk.update(again, vertices=mesh, before={"face_mask": all_faces})
    assert np.array_equal(kept.points, wider.points) and len(kept) > len(samples)
