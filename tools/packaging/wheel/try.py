"""Uses all that the wheel carries, in the environment that try-wheel installs it into."""

import importlib.metadata
import pathlib
import sys

import geodisk

vertices = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
faces = [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)]
samples = geodisk.sample(vertices, faces, min_distance=0.2, seed=7)
assert len(samples) > 200 and geodisk.verify(samples)
assert len(geodisk.transfer(samples, vertices).points) == len(samples)
assert geodisk.render(samples, size=(64, 48)).png[1:4] == b"PNG"
assert len(geodisk.sample_box([1, 1], min_distance=0.05, seed=1)) > 200
if not getattr(sys, "frozen", False):
    licenses = pathlib.Path(importlib.metadata.distribution("geodisk")._path, "licenses")
    assert {"LICENSE", "libc++.txt"} <= {path.name for path in licenses.iterdir()}
print(f"try-wheel: {len(samples)} samples on {geodisk.devices()[0].name}, {geodisk.__file__}")
