"""Meshes that usd-core writes, as files and as objects, and what it makes of the same."""

import numpy as np
import pytest

import geodisk

pxr = pytest.importorskip("pxr")
from pxr import Gf, Sdf, Usd, UsdGeom, Vt  # noqa: E402

POINTS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 2]], float)
FACES = [[3, 2, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
TRIANGLES = [[0, 2, 1], [0, 3, 2], *FACES[1:]]


def define(stage, path, faces=FACES, **attributes):
    mesh = UsdGeom.Mesh.Define(stage, path)
    mesh.CreatePointsAttr(POINTS)
    mesh.CreateFaceVertexCountsAttr([len(face) for face in faces])
    mesh.CreateFaceVertexIndicesAttr([vertex for face in faces for vertex in face])
    mesh.CreateSubdivisionSchemeAttr(attributes.pop("scheme", "none"))
    if attributes.pop("left", False):
        mesh.CreateOrientationAttr("leftHanded")
    for name, (kind, interpolation, values) in attributes.items():
        UsdGeom.PrimvarsAPI(mesh).CreatePrimvar(name, kind, interpolation).Set(values)
    return mesh


def expected_points(mesh):
    matrix = np.array(mesh.ComputeLocalToWorldTransform(Usd.TimeCode.Default()))
    return POINTS @ matrix[:3, :3] + matrix[3, :3]


def volume(mesh):
    """Positive if faces turn outwards."""
    corners = mesh.vertices[mesh.triangles]
    return np.linalg.det(corners).sum() / 6


def check(mesh, *prims):
    """Requires what the prims have, with all faces outwards."""
    places = [expected_points(prim) for prim in prims]
    assert np.allclose(mesh.vertices, np.concatenate(places), atol=1e-6)
    sizes = [abs(np.linalg.det(np.array(x.ComputeLocalToWorldTransform(0))[:3, :3])) for x in prims]
    assert volume(mesh) == pytest.approx(sum(sizes) * 2 / 3, rel=1e-5)


OPERATIONS = {
    "translate": lambda x: x.AddTranslateOp().Set((1, 2, 3)),
    "rotate": lambda x: x.AddRotateXYZOp().Set((10, 20, 30)),
    "rotate_zxy": lambda x: x.AddRotateZXYOp().Set((10, 20, 30)),
    "rotate_y": lambda x: x.AddRotateYOp().Set(90),
    "scale": lambda x: x.AddScaleOp().Set((2, 0.5, 3)),
    "mirror": lambda x: x.AddScaleOp().Set((1, -1, 2)),
    "orient": lambda x: x.AddOrientOp().Set(Gf.Quatf(Gf.Rotation((1, 2, 3), 40).GetQuat())),
    "matrix": lambda x: x.AddTransformOp().Set(
        Gf.Matrix4d().SetRotate(Gf.Rotation((1, 1, 1), 40)) * Gf.Matrix4d().SetTranslate((5, 6, 7))
    ),
    "all": lambda x: [
        x.AddTranslateOp(opSuffix="pivot").Set((1, 0, 0)),
        x.AddRotateXZYOp().Set((15, 25, 35)),
        x.AddScaleOp().Set((1, 2, -3)),
        x.AddTranslateOp(opSuffix="pivot", isInverseOp=True),
    ],
}


@pytest.mark.parametrize("left", [False, True])
@pytest.mark.parametrize("operation", OPERATIONS)
def test_places_are_those_of_usd(operation, left, tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "a.usda"))
    above = UsdGeom.Xform.Define(stage, "/World")
    OPERATIONS[operation](above)
    faces = [face[::-1] for face in FACES] if left else FACES
    first = define(stage, "/World/first", faces, left=left)
    OPERATIONS["translate"](first)
    OPERATIONS["rotate"](first)
    second = define(stage, "/World/second", faces, left=left)
    second.AddTranslateOp().Set((50, 0, 0))
    stage.Save()
    with pytest.warns(geodisk.MeshWarning, match="components"):
        mesh = geodisk.Mesh(tmp_path / "a.usda")
    check(mesh, first, second)
    check(geodisk.Mesh(first), first)
    assert len(geodisk.Mesh(second).triangles) == 6


def test_primvars_are_attributes(tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "a.usda"))
    types = Sdf.ValueTypeNames
    prim = define(
        stage, "/m", TRIANGLES,
        heat=(types.FloatArray, "vertex", [1, 2, 3, 4, 5]),
        label=(types.IntArray, "uniform", [6, 7, 8, 9, 10, 11]),
        displayColor=(types.Color3fArray, "constant", [(0.25, 0.5, 1)]),
        wind=(types.Vector3fArray, "varying", POINTS),
    )
    uv = UsdGeom.PrimvarsAPI(prim).CreatePrimvar("st", types.TexCoord2fArray, "faceVarying")
    uv.Set([(0, 0), (0.5, 0), (0, 0.25)])
    uv.SetIndices(Vt.IntArray([0, 1, 2] * 6))
    stage.Save()
    samples = [
        geodisk.sample(mesh, min_distance=0.2, attributes="all") for mesh in (tmp_path / "a.usda", prim)
    ]
    of_file, of_object = samples
    assert set(of_file.attributes) == set(of_object.attributes) == {"heat", "label", "color", "wind", "uv"}
    for name, values in of_file.attributes.items():
        assert np.allclose(values, of_object.attributes[name], atol=1e-6), name
    assert np.allclose(of_file.attributes["wind"], of_file.points, atol=1e-6)
    assert np.array_equal(of_file.attributes["label"], of_file.face_index + 6)
    assert np.allclose(of_file.attributes["uv"], of_file.barycentric[:, 1:] * [0.5, 0.25], atol=1e-6)


def test_scenes_keep_their_units_and_tell_of_subdivision(tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "a.usda"))
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    UsdGeom.SetStageUpAxis(stage, "Y")
    define(stage, "/m", scheme="catmullClark")
    UsdGeom.Sphere.Define(stage, "/s")
    hidden = define(stage, "/hidden")
    hidden.MakeInvisible()
    stage.Save()
    with pytest.warns(geodisk.MeshWarning) as told:
        mesh = geodisk.Mesh(tmp_path / "a.usda")
    kinds = {one.message.kind for one in told}
    assert kinds == {"scene_units", "control_meshes", "other_primitives", "hidden_nodes"}
    assert np.array_equal(mesh.vertices, POINTS)
    of_file = [x for x in mesh.warnings if x.kind in ("scene_units", "control_meshes")]
    with pytest.warns(geodisk.MeshWarning):
        of_object = geodisk.Mesh(UsdGeom.Mesh(stage.GetPrimAtPath("/m"))).warnings
    assert {str(x) for x in of_object} == {str(x) for x in of_file}


def test_colours_are_interpolated_as_amounts_of_light(tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "a.usda"))
    light = np.array([(0, 0, 0), (1, 0.5, 0.2), (0, 1, 0), (0.001, 0, 1), (0.3, 0.3, 1)], "f4")
    colours = (Sdf.ValueTypeNames.Color3fArray, "vertex", light)
    prim = define(stage, "/m", TRIANGLES, displayColor=colours)
    stage.Save()
    of_file, of_object = (
        geodisk.sample(mesh, min_distance=0.2, attributes=["color"]).attributes["color"]
        for mesh in (tmp_path / "a.usda", prim)
    )
    assert np.allclose(of_file, of_object, atol=1e-6)


@pytest.mark.parametrize("name", ["a.usdc", "a.usd"])
def test_binary_files_are_refused_with_the_line_that_converts(name, tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / name))
    define(stage, "/m")
    stage.Save()
    with pytest.raises(geodisk.MeshRejected, match=f"usdcat -f {name} -o a.usda"):
        geodisk.Mesh(tmp_path / name)


def test_references_instancers_and_packages_are_refused(tmp_path):
    part = Usd.Stage.CreateNew(str(tmp_path / "part.usda"))
    define(part, "/m")
    part.SetDefaultPrim(part.GetPrimAtPath("/m"))
    part.Save()
    whole = Usd.Stage.CreateNew(str(tmp_path / "whole.usda"))
    whole.DefinePrim("/a").GetReferences().AddReference("./part.usda")
    whole.Save()
    with pytest.raises(geodisk.MeshRejected, match="prim </a> has references.*usdcat -f whole.usda"):
        geodisk.Mesh(tmp_path / "whole.usda")
    whole.Flatten().Export(str(tmp_path / "flat.usda"))
    assert len(geodisk.Mesh(tmp_path / "flat.usda").triangles) == 6

    many = Usd.Stage.CreateNew(str(tmp_path / "many.usda"))
    UsdGeom.PointInstancer.Define(many, "/p")
    many.Save()
    with pytest.raises(geodisk.MeshRejected, match="prim </p> is a PointInstancer"):
        geodisk.Mesh(tmp_path / "many.usda")
    with pytest.raises(TypeError, match=r"give UsdGeom\.Mesh\(prim\)"):
        geodisk.Mesh(part.GetPrimAtPath("/m"))
    with pytest.raises(TypeError, match=r"stage\.Flatten\(\)\.Export"):
        geodisk.Mesh(part)
    for none in (UsdGeom.Mesh(), UsdGeom.Mesh(whole.GetPrimAtPath("/"))):
        with pytest.raises(TypeError, match=r"not Mesh; its prim is no mesh: keep stage"):
            geodisk.Mesh(none)


def test_samples_that_geodisk_writes_are_no_mesh(tmp_path):
    geodisk.sample(POINTS, TRIANGLES, min_distance=0.3).save(tmp_path / "a.usda")
    with pytest.raises(geodisk.MeshRejected, match="is a PointInstancer"):
        geodisk.Mesh(tmp_path / "a.usda")
