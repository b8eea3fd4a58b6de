"""One request, asked for in C, in Python and by the program: an exact count, features and levels."""

import os
import subprocess

import numpy as np

import geodisk

CORNERS = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
FACES = [
    [0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
    [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5],
]


def test_c_python_and_the_program_give_the_same_samples(tmp_path):
    told = subprocess.run([os.environ["GEODISK_C_LEVELS"]], check=True, text=True, capture_output=True)
    in_c = np.loadtxt(told.stdout.splitlines(), delimiter=",")

    samples = geodisk.sample(
        CORNERS, FACES, count=1000, exact=True, features=30, order="progressive"
    )
    columns = [samples.points, samples.columns["feature"][:, None], samples.level[:, None]]
    assert in_c.shape == (1000, 5) and np.array_equal(in_c, np.hstack(columns))

    mesh, out = tmp_path / "cube.obj", tmp_path / "cube.csv"
    mesh.write_text(
        "".join("v %g %g %g\n" % tuple(v) for v in CORNERS)
        + "".join("f %d %d %d\n" % tuple(i + 1 for i in f) for f in FACES)
    )
    options = ["-n", "1000", "--exact", "--features", "30", "--order", "progressive", "--quiet"]
    command = [os.environ["GEODISK_COMMAND"], "sample", str(mesh), "-o", str(out), *options]
    subprocess.run(command, check=True)
    rows = [line for line in out.read_text().splitlines() if not line.startswith("#")]
    names = rows[0].split(",")
    table = np.loadtxt(rows[1:], delimiter=",")
    wanted = [names.index(name) for name in ("x", "y", "z", "feature", "level")]
    assert np.array_equal(table[:, wanted], in_c)
