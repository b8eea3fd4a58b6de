"""Parameters that exclude each other, by the table of the library."""

import itertools

import numpy as np
import pytest

import geodisk
from geodisk._values import rules

CORNERS = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], float)
TETRAHEDRON = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]
POINT = ([0], [[0.25, 0.5, 0.25]])

#: How errors name the parameters that set a field, and their values.
PARAMETERS = {
    "count": ("count", {"count": 20}),
    "is_exact": ("exact", {"exact": True, "count": 20}),
    "darts": ("darts", {"darts": 100}),
    "stop_count": ("stop_count", {"stop_count": 50}),
    "maximal": ("maximal", {"maximal": True}),
    "radii": ("radius_factor", {"radius_factor": np.ones(4)}),
    "density": ("density", {"density": np.ones(4)}),
    "class_factors": ("classes", {"classes": 2}),
    "class_counts": ("class_counts", {"class_counts": [2, 2], "classes": 2}),
    "face_keys": ("face_keys", {"face_keys": [3, 2, 1, 0]}),
    "existing": ("existing", {"existing": POINT}),
    "avoid": ("avoid", {"avoid": (POINT, 0.1)}),
    "features": ("features", {"features": 30}),
    "at_vertices": ("at_vertices", {"at_vertices": True}),
    "progressive": ("order='progressive'", {"order": "progressive"}),
    "farthest": ("order='farthest'", {"order": "farthest"}),
    "metric": ("metric='euclidean'", {"metric": "euclidean"}),
}
#: Of the update of samples, of other meshes, of several processes and of engines.
ELSEWHERE = {"keep", "frame", "split_from", "update", "processes", "frames"}


def test_all_fields_are_known():
    fields = {field for rule in rules() for field in rule[:2]}
    assert fields - ELSEWHERE <= PARAMETERS.keys()
    assert len(rules()) > 30


@pytest.mark.parametrize("a, b", itertools.combinations(PARAMETERS, 2))
def test_parameters_are_refused_by_name_where_their_fields_exclude_each_other(a, b):
    given = {**PARAMETERS[a][1], **PARAMETERS[b][1]}
    if {a, b} in ({"radii", "density"}, {"progressive", "farthest"}):
        return  # One parameter has one value, and the other two are refused in another way.
    if "count" not in given:
        given["min_distance"] = 0.5
    if given.get("at_vertices") and given.get("count"):
        given["count"] = 3  # Of four vertices.
    fields = {a, b}
    fields |= {"radii"} if "density" in fields else set()
    fields |= {"count"} if "is_exact" in fields else set()
    fields |= {"class_factors"} if "class_counts" in fields else set()
    broken = [rule for rule in rules() if {*rule[:2]} <= fields]
    if not broken:
        if given.get("count") is None or "darts" not in given:
            assert len(geodisk.sample(CORNERS, TETRAHEDRON, **given)) >= 1
        return
    field, other, reason = broken[0]
    names = {**{name: told for name, (told, _) in PARAMETERS.items()}}
    if "density" in fields:
        names["radii"] = "density"
    with pytest.raises(geodisk.InvalidArgument) as error:
        geodisk.sample(CORNERS, TETRAHEDRON, **given)
    assert str(error.value) == f"{names[field]} and {names[other]} exclude each other: {reason}"
