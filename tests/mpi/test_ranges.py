"""geodisk_mpi on binary PLY files, which all processes read in ranges: the files of `geodisk sample`,
and what has to be read as a whole."""

import json
import math
import os
import random
import struct
import threading

import pytest

from launching import PROGRAM, alone, run
from surfaces import grid, torus, write_ply


def shuffled(vertices, faces, seed=1):
    """The same surface with vertices and faces in an order that has nothing to do with their places,
    some vertices in no face, and faces turned over."""
    order = list(range(len(vertices) + 7))
    chance = random.Random(seed)
    chance.shuffle(order)
    places = [(9.0, 9.0, 9.0)] * len(order)
    for vertex, place in zip(order, vertices):
        places[vertex] = place
    turned = [tuple(order[v] for v in (face if chance.random() < 0.7 else face[::-1]))
              for face in faces]
    chance.shuffle(turned)
    return places, turned


def check_same(tmp_path, arguments, counts, name="samples.ply", more=()):
    """Any number of processes writes the file of one, and says nothing but what is odd. `more` are
    arguments of theirs alone."""
    expected = tmp_path / f"alone-{name}"
    alone(*arguments, "-o", str(expected))
    for count in counts:
        found = tmp_path / f"{count}-{name}"
        code, _, errors = run(count, "sample", *arguments, "-o", str(found), "--quiet", *more)
        assert code == 0, errors
        assert all(line.startswith("geodisk_mpi: warning: ") for line in errors.splitlines())
        assert found.read_bytes() == expected.read_bytes(), count


def is_read_in_ranges(tmp_path, mesh, *arguments, processes=2):
    """Whether no process reads the whole."""
    code, _, errors = run(processes, "sample", str(mesh), "-o", str(tmp_path / "probe.ply"),
                          *arguments)
    assert code == 0, errors
    return "process 0 reads all of" not in errors


def test_same_file_for_any_number_of_processes(tmp_path):
    mesh = tmp_path / "torus.ply"
    write_ply(mesh, *shuffled(*torus(60, 24)))
    assert is_read_in_ranges(tmp_path, mesh, "--min-distance", "5%")
    check_same(tmp_path, [str(mesh), "--min-distance", "3%", "--seed", "3"], [1, 2, 3, 4, 7])


def test_same_file_for_any_number_of_parts(tmp_path):
    mesh = tmp_path / "torus.ply"
    write_ply(mesh, *shuffled(*torus(60, 24)))
    arguments = [str(mesh), "--min-distance", "3%", "--seed", "3"]
    for processes, parts in [(1, 3), (2, 2), (3, 5)]:
        report = tmp_path / "report.json"
        check_same(tmp_path, arguments, [processes], more=["--parts", str(parts), "--json",
                                                           str(report)])
        told = json.loads(report.read_text())["processes"]
        assert [p["parts"] for p in told] == [parts] * processes
        assert sum(p["own_faces"] for p in told) == 2880
    darts = [str(mesh), "--count", "80", "--min-distance", "4%", "--method", "darts"]
    check_same(tmp_path, darts, [2], "darts.ply", ["--parts", "3"])
    check_same(tmp_path, [str(mesh), "--count", "200", "--exact"], [2], "exact.ply",
               ["--parts", "3"])
    # Parts of a few distances, and a distance that is as wide as the surface.
    check_same(tmp_path, [str(mesh), "--min-distance", "60%"], [2], "wide.ply", ["--parts", "4"])
    # No more parts than faces, and none where process 0 reads the whole.
    few = tmp_path / "few.ply"
    write_ply(few, *grid(2, 1))
    check_same(tmp_path, [str(few), "--min-distance", "0.3"], [3], "few.ply", ["--parts", "128"])
    check_same(tmp_path, [str(few), "--count", "20"], [2], "whole.ply", ["--parts", "2"])


def test_same_file_of_other_runs(tmp_path):
    mesh = tmp_path / "torus.ply"
    write_ply(mesh, *torus(48, 20), order=">", real="f")
    assert is_read_in_ranges(tmp_path, mesh, "--count", "60")
    check_same(tmp_path, [str(mesh), "--count", "200"], [3], "count.csv")
    check_same(tmp_path, [str(mesh), "--count", "100", "--exact"], [2], "exact.npz")
    check_same(tmp_path, [str(mesh), "--count", "80", "--min-distance", "4%", "--method", "darts"],
               [3], "darts.ply")
    check_same(tmp_path, [str(mesh), "--min-distance", "60%"], [5], "large.ply")


def test_same_file_of_odd_surfaces(tmp_path):
    sheet, faces = grid(20, 12)
    fins = [(at, at + 1, len(sheet) + at % 5) for at in range(0, 200, 17)]
    fin_ends = [(0.2 * k, 0.5, 1.0) for k in range(5)]
    ball = [(x + 5, y, z) for x, y, z in torus(16, 8)[0]]
    first = len(sheet) + len(fin_ends)
    ball_faces = [tuple(first + v for v in face) for face in torus(16, 8)[1]]
    flat = [(0, 0, 5), (3, 3, 4)]
    vertices = sheet + fin_ends + ball
    mesh = tmp_path / "odd.ply"
    write_ply(mesh, *shuffled(vertices, faces + fins + ball_faces + flat, seed=4))
    assert is_read_in_ranges(tmp_path, mesh, "--min-distance", "0.2")
    check_same(tmp_path, [str(mesh), "--min-distance", "0.1"], [2, 4])
    few = tmp_path / "few.ply"
    write_ply(few, *grid(2, 1))
    check_same(tmp_path, [str(few), "--min-distance", "0.3"], [1, 4], "few.ply")


def test_same_file_of_steep_hills(tmp_path):
    # Obtuse angles: ways along edges are far longer than lower bounds on distances.
    steep = lambda u, v: (u, v, 0.25 * math.sin(14 * u) * math.cos(11 * v))
    mesh = tmp_path / "hills.ply"
    write_ply(mesh, *grid(60, 50, steep))
    assert is_read_in_ranges(tmp_path, mesh, "--min-distance", "0.1", processes=4)
    check_same(tmp_path, [str(mesh), "--min-distance", "0.05"], [4])
    assert is_read_in_ranges(tmp_path, mesh, "--count", "100")
    check_same(tmp_path, [str(mesh), "--count", "300"], [3], "count.ply")


def with_properties(path, vertices, faces, **more):
    """A mesh with a density from 0 to 300, radius factors, and a group of each face."""
    of_vertices = {
        "heat": [max(0.0, 300 * math.sin(2 * x) * math.cos(y)) for x, y, _ in vertices],
        "g": [0.3 + 0.35 * (1 + math.sin(3 * x + y)) for x, y, _ in vertices],
        "wide": [2.0 ** -min(5, 2 * abs(x)) for x, _, _ in vertices],
        "thin": [0.002 * (1 + (i % 5)) for i in range(len(vertices))]}
    write_ply(path, vertices, faces, of_vertices=of_vertices,
              of_faces={"group": [i % 4 for i in range(len(faces))]}, **more)


@pytest.fixture(scope="module", params=["torus", "sheet"])
def properties(request, tmp_path_factory):
    """A closed surface, and one with borders, edges of three faces, and unused vertices."""
    path = tmp_path_factory.mktemp("properties") / f"{request.param}.ply"
    if request.param == "torus":
        with_properties(path, *shuffled(*torus(48, 20)), order=">")
    else:
        vertices, faces = grid(36, 24)
        fins = [(at, at + 1, len(vertices)) for at in range(0, 700, 57)]
        with_properties(path, *shuffled(vertices + [(0.4, 0.5, 1.5)], faces + fins, seed=2))
    return path


@pytest.mark.parametrize("arguments, runs", [
    (["--density", "heat", "--min-distance", "1.5%"], [(3, 2)]),
    (["--density", "heat", "--count", "300"], [(3, 1)]),
    (["--radius-factor", "g", "--min-distance", "6%"], [(2, 3)]),
    (["--radius-factor", "g", "--count", "200", "--exact"], [(2, 2)]),
    (["--radius-factor", "thin", "--radius-factor-floor", "0.4", "--count", "300"], [(3, 1)]),
    (["--radius-factor", "wide", "--count", "1500"], [(2, 3), (1, 8)]),
    (["--mask", "x>0.1", "--min-distance", "3%"], [(2, 2), (5, 1)]),
    (["--mask", "x>0.1", "--mask", "group!=2", "--mask", "g>0.4", "--count", "150"], [(2, 2)]),
    (["--mask", "z<100", "--count", "150"], [(3, 1)]),
    (["--density", "heat", "--mask", "group>=2", "--count", "200"], [(2, 2)]),
    (["--radius-factor", "g", "--mask", "y<0.5", "--count", "30", "--min-distance", "5%",
      "--method", "darts"], [(2, 2)]),
])
def test_same_file_with_radii_and_masks(properties, tmp_path, arguments, runs):
    for processes, parts in runs:
        report = tmp_path / "report.json"
        check_same(tmp_path, [str(properties), *arguments, "--seed", "5"], [processes],
                   more=["--parts", str(parts), "--json", str(report)])
        # No process had the whole.
        told = json.loads(report.read_text())["processes"]
        assert [p["parts"] for p in told] == [parts] * processes
        assert all(p["part_bytes"] == 0 for p in told)


@pytest.mark.parametrize("processes", [1, 4, 5])
@pytest.mark.parametrize("arguments", [
    ["--density", "heat", "--count", "40"], ["--radius-factor", "g", "-d", "0.4"],
    ["--mask", "g<1", "--mask", "group=1", "-d", "0.2"]])
def test_few_faces_with_odd_vertices(tmp_path, processes, arguments):
    """Hardly more vertices than processes, one of which only a face without area names, with values
    that no other may have."""
    vertices = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 0.6), (9, 9, 9)]
    faces = [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4), (4, 5, 5), (0, 2, 1)]
    mesh = tmp_path / "few.ply"
    write_ply(mesh, vertices, faces,
              of_vertices={"heat": [1, 2, 3, 4, 0, -5], "g": [0.5, 0.6, 0.7, 0.8, 0.9, 7]},
              of_faces={"group": [1, 1, 0, 1, 1, 1]})
    check_same(tmp_path, [str(mesh), *arguments], [processes])


def test_report_of_radii_and_a_mask(properties, tmp_path):
    told = []
    files = []
    for launch in [lambda *a: alone(*a), lambda *a: run(3, "sample", *a, "--quiet")]:
        report, out = tmp_path / "report.json", tmp_path / "s.csv"
        launch(str(properties), "--density", "heat", "--mask", "group>0", "-d", "1.5%", "-o",
               str(out), "--json", str(report))
        told.append(json.loads(report.read_text()))
        files.append(out.read_bytes())
    assert files[0] == files[1]
    for key in ["mesh", "samples", "sample_radii", "min_distance", "rho"]:
        assert told[0][key] == told[1][key], key


@pytest.mark.parametrize("of_vertices, arguments, code, message", [
    ({"heat": -1.0}, ["--density", "heat"], 3, "the density of vertex 0 (from 0) is -1"),
    ({"heat": 0.0}, ["--density", "heat"], 3, "the density is 0 everywhere"),
    ({"g": 0.0}, ["--radius-factor", "g"], 3, "all radius factors g are zero"),
    ({"g": 0.0}, ["--radius-factor", "g", "--radius-factor-floor", "0.5"], 3,
     "all radius factors g are zero"),
    ({"g": 2.0}, ["--radius-factor", "g"], 3, "the radius factor g of vertex 0 (from 0) is 2"),
    ({"g": math.nan}, ["--mask", "g<1"], 3, "has no face that --mask allows"),
    ({"g": 0.5}, ["--mask", "x>9"], 3, "has no face that --mask allows"),
    ({"g": 0.5}, ["--mask", "f>9"], 3, "has no attribute 'f'; it has g"),
    ({"g": 0.5}, ["--density", "f"], 3, "has no attribute 'f'; it has g"),
    ({"g": 0.5}, ["--mask", "x7>9"], 2, "the mesh has 3 coordinates per vertex"),
])
def test_bad_radii_and_masks_are_told_once(tmp_path, of_vertices, arguments, code, message):
    vertices, faces = grid(8, 5)
    mesh = tmp_path / "sheet.ply"
    write_ply(mesh, vertices, faces, of_vertices={
        name: [value] * len(vertices) for name, value in of_vertices.items()})
    out = tmp_path / "s.ply"
    found, _, errors = run(2, "sample", str(mesh), "-d", "0.2", *arguments, "-o", str(out),
                           "--quiet")
    assert found == code and message in errors and not out.exists()
    assert errors.count("\n") == 1, errors


def test_small_factors_are_raised_with_a_warning(tmp_path):
    vertices, faces = grid(12, 8)
    mesh = tmp_path / "sheet.ply"
    write_ply(mesh, vertices, faces, of_vertices={"g": [0.0001] + [0.5] * (len(vertices) - 1)})
    check_same(tmp_path, [str(mesh), "--radius-factor", "g", "-d", "0.3"], [2])
    assert "g is below 0.001 at 1 vertex" in run(
        2, "sample", str(mesh), "--radius-factor", "g", "-d", "0.3", "-o",
        str(tmp_path / "s.ply"))[2]


def test_report_counts_what_the_ranges_have(tmp_path):
    vertices, faces = grid(14, 9)
    other, other_faces = torus(12, 6)
    faces = faces + [tuple(v + len(vertices) for v in face) for face in other_faces]
    mesh = tmp_path / "two.ply"
    write_ply(mesh, *shuffled(vertices + [(x + 4, y, z) for x, y, z in other], faces))
    told = []
    for name in ["alone", "ranges"]:
        report = tmp_path / f"{name}.json"
        arguments = [str(mesh), "--min-distance", "0.2", "-o", str(tmp_path / "s.ply"),
                     "--json", str(report)]
        if name == "alone":
            alone(*arguments)
        else:
            assert run(3, "sample", *arguments, "--quiet")[0] == 0
        told.append(json.loads(report.read_text()))
    assert told[0]["mesh"] == told[1]["mesh"]
    kinds = [{w["kind"]: w["count"] for w in one["warnings"]} for one in told]
    for kind in ["components", "inconsistent_orientation", "unused_vertices"]:
        assert kinds[0][kind] == kinds[1][kind]
    processes = told[1]["processes"]
    assert sum(p["own_faces"] for p in processes) == len(faces)
    assert max(p["own_faces"] for p in processes) < 0.7 * len(faces)


def doubled(vertices, faces):
    """Every face with vertices of its own, which joins faces by place alone."""
    return ([vertices[v] for face in faces for v in face],
            [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(len(faces))])


@pytest.mark.parametrize("name, mesh", [
    ("seams", doubled(*grid(8, 5))),
    ("copies", (grid(8, 5)[0], grid(8, 5)[1] + [grid(8, 5)[1][3][::-1]])),
    ("quads", (grid(8, 5)[0], grid(8, 5)[1] + [(0, 6, 13, 20)])),
])
def test_what_needs_the_whole_is_read_as_a_whole(tmp_path, name, mesh):
    path = tmp_path / f"{name}.ply"
    write_ply(path, *mesh)
    assert not is_read_in_ranges(tmp_path, path, "--min-distance", "0.2")
    check_same(tmp_path, [str(path), "--min-distance", "0.15"], [3])


def test_distance_beyond_the_surface_needs_the_whole(tmp_path):
    mesh = tmp_path / "sheet.ply"
    write_ply(mesh, *grid(8, 5))
    assert not is_read_in_ranges(tmp_path, mesh, "--min-distance", "300%")
    check_same(tmp_path, [str(mesh), "--min-distance", "300%"], [2])


def test_count_that_comes_to_a_distance_beyond_the_surface(tmp_path):
    """Process 0 then reads the whole, in the midst of the search."""
    mesh = tmp_path / "rough.ply"
    vertices, faces = grid(29, 18)
    factors = [1.0 if i * 7 % 11 < 5 else 1 / 32 for i in range(len(vertices))]
    write_ply(mesh, vertices, faces, of_vertices={"g": factors})
    check_same(tmp_path, [str(mesh), "--radius-factor", "g", "--count", "73"], [1, 2],
               more=["--parts", "4"])


@pytest.mark.parametrize("spoil, message", [
    (lambda data: data[:-5], "the file ends inside element face"),
    (lambda data: data[:-4] + struct.pack("<i", 999), "vertex index 999 is out of range"),
    (lambda data: data[:-4] + struct.pack("<i", -1), "vertex index -1 is out of range"),
    (lambda data: data.replace(b"end_header", b"end_head"), "inside the header"),
])
def test_bad_files_are_told_once(tmp_path, spoil, message):
    mesh = tmp_path / "bad.ply"
    write_ply(mesh, *grid(8, 5))
    mesh.write_bytes(spoil(mesh.read_bytes()))
    out = tmp_path / "s.ply"
    code, _, errors = run(3, "sample", str(mesh), "--count", "20", "-o", str(out), "--quiet")
    assert code == 3 and message in errors and not out.exists()
    assert errors.count("\n") == 1, errors


@pytest.mark.parametrize("name", ["missing.ply", "folder.ply"])
def test_unreadable_files_are_told_in_one_line(tmp_path, name):
    (tmp_path / "folder.ply").mkdir()
    out = tmp_path / "s.ply"
    code, _, errors = run(2, "sample", str(tmp_path / name), "--count", "20", "-o", str(out))
    assert code == 3 and not out.exists()
    assert errors.count("\n") == 1 and "process 0 reads" not in errors, errors


def test_more_processes_than_faces(tmp_path):
    mesh = tmp_path / "one.ply"
    write_ply(mesh, *grid(1, 1))
    out = tmp_path / "s.ply"
    code, _, errors = run(3, "sample", str(mesh), "--min-distance", "0.2", "-o", str(out),
                          "--quiet")
    assert code == 2 and errors.count("\n") == 1 and not out.exists()
    assert "there are 3 processes, but the mesh has 2 faces" in errors


@pytest.mark.parametrize("there", ["missing", "shorter"])
def test_file_that_processes_do_not_share(tmp_path, there):
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
    write_ply(tmp_path / "one" / "a.ply", *torus(90, 30))
    if there == "shorter":
        write_ply(tmp_path / "two" / "a.ply", *torus(60, 30))
    sample = ["sample", "a.ply", "--count", "20", "-o", str(tmp_path / "s.ply"), "--quiet"]
    parts = ["-wdir", str(tmp_path / "one"), PROGRAM, *sample, ":", "-n", "1"]
    parts += ["-wdir", str(tmp_path / "two")]
    code, _, errors = run(1, *sample, program=parts)
    assert code == 3 and not (tmp_path / "s.ply").exists()
    told = "cannot be opened on process 1" if there == "missing" else "differs on process 1: "
    assert errors.count("\n") == 1 and f"geodisk_mpi: a.ply: {told}" in errors


def test_file_that_changes_while_it_is_read(tmp_path):
    mesh = tmp_path / "torus.ply"
    write_ply(mesh, *torus(900, 300))
    out = tmp_path / "s.ply"
    ends = threading.Event()

    def touch():
        while not ends.is_set():
            os.utime(mesh)

    thread = threading.Thread(target=touch)
    thread.start()
    try:
        code, _, errors = run(3, "sample", str(mesh), "--count", "20", "-o", str(out), "--quiet")
    finally:
        ends.set()
        thread.join()
    assert code == 3 and not out.exists()
    assert errors.count("\n") == 1 and f"{mesh}: changed while it was read" in errors
