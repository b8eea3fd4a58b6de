"""geodisk_mpi verify: the answer of `geodisk verify`, for any number of processes."""

import os
import subprocess

from launching import ENVIRONMENT, alone, run

MESH = "builtin:torus-knot"


def check_same(tmp_path, arguments, counts=(1, 2, 3, 4, 7), expected=0):
    """Compares exit status, output and report with those of one process without MPI."""
    report = tmp_path / "alone.json"
    done = subprocess.run(
        [os.environ["GEODISK_COMMAND"], "verify", *arguments, "--json", str(report)],
        env=ENVIRONMENT, text=True, capture_output=True)
    assert done.returncode == expected, done.stderr
    for count in counts:
        found = tmp_path / f"{count}.json"
        code, output, errors = run(count, "verify", *arguments, "--json", str(found))
        assert (code, output) == (expected, done.stdout), (count, errors)
        assert errors.replace("geodisk_mpi: ", "geodisk: ") == done.stderr, count
        assert found.read_bytes() == report.read_bytes(), count
    return done


def moved_together(source, target, pairs):
    """Copies samples as CSV, and puts some rows where others are."""
    lines = source.read_text().splitlines()
    start = next(i for i, line in enumerate(lines) if line[:1] not in "#%" and "," in line) + 1
    for row, other in pairs:
        lines[start + row] = lines[start + other]
    target.write_text("\n".join(lines) + "\n")


def test_spaced_samples(tmp_path):
    samples = tmp_path / "samples.csv"
    alone(MESH, "--min-distance", "2%", "-o", str(samples))
    check_same(tmp_path, [MESH, str(samples)])
    check_same(tmp_path, [MESH, str(samples), "--min-distance", "2.1%"], (3,), expected=1)


def test_pairs_that_are_too_close(tmp_path):
    samples, broken = tmp_path / "samples.csv", tmp_path / "broken.csv"
    alone(MESH, "--count", "400", "-o", str(samples))
    moved_together(samples, broken, [(3, 250), (17, 90), (399, 90)])
    done = check_same(tmp_path, [MESH, str(broken)], expected=1)
    assert "samples 3 and 250: 0" in done.stdout
    warning, error = done.stderr.splitlines()
    assert "do not fit the" in warning and "4 pairs of samples are closer" in error


def test_radii_classes_levels_and_existing_samples(tmp_path):
    samples = tmp_path / "samples.csv"
    given = tmp_path / "given.csv"
    alone(MESH, "--radius-factor", "curvature", "--count", "300", "-o", str(samples))
    check_same(tmp_path, [MESH, str(samples)], (3,))
    alone(MESH, "--classes", "3", "--count", "300", "-o", str(samples))
    check_same(tmp_path, [MESH, str(samples), "--classes", "3"], (3,))
    alone(MESH, "--count", "200", "--order", "progressive", "-o", str(samples))
    check_same(tmp_path, [MESH, str(samples)], (3,))
    alone(MESH, "--count", "60", "--seed", "9", "-o", str(given))
    alone(MESH, "--min-distance", "9%", "--existing", str(given), "-o", str(samples))
    check_same(tmp_path, [MESH, str(samples), "--avoid", f"{given}:1%"], (4,), expected=0)


def test_closest_pair_without_a_distance(tmp_path):
    samples, points = tmp_path / "samples.csv", tmp_path / "points.xyz"
    alone(MESH, "--count", "100", "-o", str(points))
    check_same(tmp_path, [MESH, str(points)], (1, 3))
    alone("builtin:cube", "--min-distance", "200%", "-o", str(samples))
    check_same(tmp_path, ["builtin:cube", str(samples), "--min-distance", "150%"], (2, 5))


def test_hopeless_samples(tmp_path):
    """More pairs are too close than are looked for: the same ones are found."""
    samples, broken = tmp_path / "samples.csv", tmp_path / "broken.csv"
    alone(MESH, "--count", "2100", "--exact", "-o", str(samples))
    moved_together(samples, broken, [(row, row % 3) for row in range(3, 2100)])
    done = check_same(tmp_path, [MESH, str(broken)], (3,), expected=1)
    assert "at least" in done.stderr


def test_faults_are_told_once(tmp_path):
    samples, others = tmp_path / "samples.csv", tmp_path / "others.csv"
    alone("builtin:cube", "--count", "20", "-o", str(samples))
    alone(MESH, "--count", "20", "-o", str(others))
    for arguments, status, message in [
            (["builtin:cube", str(tmp_path / "none.csv")], 3, "none.csv"),
            (["builtin:cube", str(others)], 3, str(others)),
            (["builtin:cube"], 2, "SAMPLES is required"),
            (["builtin:cube", str(samples), "--min-distance", "-1"], 2, "--min-distance")]:
        code, _, errors = run(3, "verify", *arguments)
        assert code == status, errors
        assert errors.startswith("geodisk_mpi: ") and message in errors
        assert errors.count("\n") == 1
    code, _, errors = run(13, "verify", "builtin:cube", str(samples))
    assert code == 2 and errors.count("\n") == 1
    assert "there are 13 processes, but the mesh has 12 faces" in errors
