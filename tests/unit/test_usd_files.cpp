// Meshes of USD: texts as usd-core, Blender and people write them.
#include "array_facts.hpp"
#include "files/meshes/named_files.hpp"
#include "mesh_bytes.hpp"
#include "test_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

using namespace geodisk::tools;

namespace {

using UsdCorners = std::vector<std::uint32_t>;

const std::string kUsdHead = "#usda 1.0\n";
const std::string kUsdSquare =
    "int[] faceVertexCounts = [3, 3]\nint[] faceVertexIndices = [0, 1, 2, 0, 2, 3]\n"
    "point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]\n";
const std::string kNoScheme = "uniform token subdivisionScheme = \"none\"\n";

std::string usd_mesh(const std::string& properties, const std::string& name = "m",
                     const std::string& metadata = "") {
    return "def Mesh \"" + name + "\" " + metadata + "\n{\n" + kNoScheme + properties + "}\n";
}

std::string xform(const std::string& operations, const std::string& order,
                  const std::string& inside) {
    return "def Xform \"x\"\n{\n" + operations + "uniform token[] xformOpOrder = [" + order +
           "]\n" + inside + "}\n";
}

void check_point(const MeshFile& mesh, std::size_t vertex, double x, double y, double z) {
    const double* const p = &mesh.positions.at(3 * vertex);
    CAPTURE(p[0]);
    CAPTURE(p[1]);
    CAPTURE(p[2]);
    CHECK(std::abs(p[0] - x) + std::abs(p[1] - y) + std::abs(p[2] - z) < 1e-6);
}

/// The square moved as the operations say.
MeshFile placed(const std::string& operations, const std::string& order) {
    return geodisk::tools::mesh_of("a.usda",
                                   kUsdHead + xform(operations, order, usd_mesh(kUsdSquare)));
}

void check_usd_refused(const std::string& text, std::string_view part) {
    geodisk::tools::check_refused("a.usda", kUsdHead + text, part);
}

/// The values of an attribute at the corners of all triangles.
std::vector<double> at_corners(const MeshFile& mesh, std::string_view name,
                               std::size_t component = 0) {
    const auto found = std::ranges::find(mesh.fields, name, &MeshField::name);
    REQUIRE(found != mesh.fields.end());
    std::vector<double> result;
    for (std::size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
        result.push_back(found->values.at(
            mesh.value_index(*found, corner) * found->components.size() + component));
    }
    return result;
}

} // namespace

TEST_CASE("meshes of USD are read, one after the other") {
    const std::string second =
        usd_mesh("int[] faceVertexCounts = [4]\nint[] faceVertexIndices = [3, 2, 1, 0]\n"
                 "float3[] points = [ (0,0,1),(2,0,1),\n(2,1,1), (0,1,1), ]\n",
                 "n");
    const MeshFile mesh = geodisk::tools::mesh_of(
        "a.usda", kUsdHead + "(\n    \"a comment\"\n    doc = \"\"\"x\n(\"\"\"\n)\n" +
                      usd_mesh(kUsdSquare) + "# def\n// def\n/* def\n/* */" + second);
    CHECK(mesh.positions.size() == 24);
    CHECK(mesh.triangles.size() == 12);
    CHECK(UsdCorners(mesh.triangles.begin(), mesh.triangles.begin() + 6) ==
          UsdCorners{0, 1, 2, 0, 2, 3});
    CHECK(mesh.polygons == UsdCorners{0, 1, 2, 2});
    REQUIRE(mesh.parts.size() == 2);
    CHECK(mesh.part_of_triangle == UsdCorners{0, 0, 1, 1});
    CHECK(mesh.part_names.nodes == std::vector<std::string>{"m", "n"});
    // Another name of the format, and Windows.
    std::string windows;
    for (const char c : kUsdHead + usd_mesh(kUsdSquare)) {
        windows += c == '\n' ? "\r\n" : std::string(1, c);
    }
    const MeshFile one = geodisk::tools::mesh_of("a.usd", windows);
    CHECK(one.triangles.size() == 6);
    CHECK(one.warnings.empty());
    check_fails(ExitCode::bad_input, "line 3: the comment that begins here has no end",
                [] { geodisk::tools::mesh_of("a.usda", kUsdHead + "\n/* def\n"); });
}

TEST_CASE("operations of prims place meshes of USD") {
    check_point(placed("double3 xformOp:translate = (5, 6, 7)\n", "\"xformOp:translate\""), 1, 6, 6,
                7);
    check_point(placed("float3 xformOp:scale = (2, 3, 4)\n", "\"xformOp:scale\""), 2, 2, 3, 0);
    // About x, y and z in turn: (1, 0, 0) stays, goes to -z, stays.
    check_point(placed("float3 xformOp:rotateXYZ = (90, 90, 90)\n", "\"xformOp:rotateXYZ\""), 1, 0,
                0, -1);
    check_point(placed("float3 xformOp:rotateZYX = (90, 90, 90)\n", "\"xformOp:rotateZYX\""), 1, 0,
                0, 1);
    check_point(placed("double xformOp:rotateZ = 90\n", "\"xformOp:rotateZ\""), 1, 0, 1, 0);
    check_point(placed("double xformOp:rotateZ = -30\n", "\"xformOp:rotateZ\""), 1, std::sqrt(0.75),
                -0.5, 0);
    check_point(placed("quatf xformOp:orient = (2, 0, 0, 2)\n", "\"xformOp:orient\""), 1, 0, 1, 0);
    check_point(placed("matrix4d xformOp:transform = ( (0, 1, 0, 0), (-1, 0, 0, 0), (0, 0, 1, 0), "
                       "(5, 6, 7, 1) )\n",
                       "\"xformOp:transform\""),
                1, 5, 7, 7);
    // The first of the order is applied last; without an order nothing is.
    check_point(placed("double3 xformOp:translate = (5, 0, 0)\nfloat3 xformOp:scale = (2, 2, 2)\n",
                       "\"xformOp:translate\", \"xformOp:scale\""),
                1, 7, 0, 0);
    check_point(
        placed("double3 xformOp:translate:pivot = (1, 0, 0)\ndouble xformOp:rotateZ = 180\n",
               "\"xformOp:translate:pivot\", \"xformOp:rotateZ\", "
               "\"!invert!xformOp:translate:pivot\""),
        0, 2, 0, 0);
    check_point(geodisk::tools::mesh_of(
                    "a.usda", kUsdHead +
                                  "def Xform \"x\"\n{\ndouble3 xformOp:translate = (5, 0, 0)\n" +
                                  usd_mesh(kUsdSquare) + "}\n"),
                0, 0, 0, 0);
    const std::string outer = "float3 xformOp:scale = (2, 2, 2)\n", scale = "\"xformOp:scale\"";
    for (const auto& [reset, y] :
         {std::pair<std::string, double>{"", 2}, {"\"!resetXformStack!\", ", 1}}) {
        const std::string inner = "double3 xformOp:translate = (0, 1, 0)\nuniform token[] "
                                  "xformOpOrder = [" +
                                  reset + "\"xformOp:translate\"]\n";
        check_point(geodisk::tools::mesh_of(
                        "a.usda", kUsdHead + xform(outer, scale, usd_mesh(kUsdSquare + inner))),
                    0, 0, y, 0);
    }
    // Mirrored and left-handed meshes are turned over, but not what is both.
    const std::string left = "uniform token orientation = \"leftHanded\"\n";
    const std::string mirror = "float3 xformOp:scale = (1, 1, -1)\n";
    CHECK(placed(mirror, scale).triangles == UsdCorners{0, 2, 1, 0, 3, 2});
    CHECK(geodisk::tools::mesh_of("a.usda", kUsdHead + usd_mesh(left + kUsdSquare)).triangles ==
          UsdCorners{0, 2, 1, 0, 3, 2});
    CHECK(geodisk::tools::mesh_of("a.usda",
                                  kUsdHead + xform(mirror, scale, usd_mesh(left + kUsdSquare)))
              .triangles == UsdCorners{0, 1, 2, 0, 2, 3});
}

TEST_CASE("values of USD in time are those of the first time, which is told") {
    const MeshFile mesh =
        placed("double3 xformOp:translate.timeSamples = {\n 1: (5, 6, 7),\n 24: (0, 0, 0),\n}\n",
               "\"xformOp:translate\"");
    check_point(mesh, 0, 5, 6, 7);
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0].kind == "time_samples");
    const MeshFile still = placed("double3 xformOp:translate.timeSamples = { 1: (5, 6, 7) }\n"
                                  "double3 xformOp:translate = (1, 2, 3)\n",
                                  "\"xformOp:translate\"");
    check_point(still, 0, 1, 2, 3);
}

TEST_CASE("what of a scene of USD is no surface is left out, and told") {
    const std::string mesh = usd_mesh(kUsdSquare);
    const auto warnings_of = [](const std::string& text) {
        std::vector<std::string> kinds;
        for (const MeshWarning& warning :
             geodisk::tools::mesh_of("a.usda", kUsdHead + text).warnings) {
            kinds.push_back(warning.kind);
        }
        return kinds;
    };
    using Kinds = std::vector<std::string>;
    const std::string hidden = "def Mesh \"h\" {\ntoken visibility = \"invisible\"\n}\n"
                               "def Scope \"g\" {\nuniform token purpose = \"guide\"\n" +
                               mesh + "}\n";
    CHECK(warnings_of(mesh + hidden) == Kinds{"hidden_nodes"});
    CHECK(warnings_of(mesh + "def Sphere \"s\" { double radius = 2 }\n") ==
          Kinds{"other_primitives"});
    CHECK(warnings_of("def Mesh \"m\" {\n" + kUsdSquare + "}\n") == Kinds{"control_meshes"});
    CHECK(warnings_of("(\n metersPerUnit = 0.01\n upAxis = \"Y\"\n)\n" + mesh) ==
          Kinds{"scene_units"});
    CHECK(warnings_of("(\n metersPerUnit = 1\n upAxis = \"Y\"\n)\n" + mesh).empty());
    const std::string three(3, '\'');
    const std::string rest =
        "class Mesh \"c\" (references = @b.usda@) { }\n"
        "over \"o\" (payload = @b.usda@</a>) { def Mesh \"x\" { } }\n"
        "def Xform \"off\" (\n active = false\n prepend references = @b.usda@ (offset = 1)\n)\n"
        "{\n int x = {}\n}\n"
        "def Material \"r\" (references = @m.usda@) {\n"
        " token outputs:surface.connect = </r/s.outputs:out>\n}\n"
        "def Scope \"custom\" (\n customData = { dictionary d = { string s = \")\" } }\n"
        " delete references = @b.usda@\n)\n{\n custom string note = " +
        three + "a \"\n)" + three +
        "\n rel target = [</m>, </n>]\n float a\n asset file = @@@a@b.png@@@\n"
        " reorder properties = [\"a\"]\n bool b = true ; int[] none = None\n"
        " float[] t.timeSamples = { 0: [1, 2], 1: None }\n"
        " string[] words = [\"a, b\", 'c\\'d']\n}\n";
    CHECK(warnings_of(mesh + rest).empty());
}

TEST_CASE("primvars of USD are attributes, materials and prims are parts") {
    const std::string values =
        "float[] primvars:heat = [1, 2, 3, 4] ( interpolation = \"vertex\" )\n"
        "int[] primvars:label = [7, 8] ( interpolation = \"uniform\" )\n"
        "color3f[] primvars:displayColor = [(1, 0, 0)]\n"
        "texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1)] ( interpolation = \"faceVarying\" )\n"
        "int[] primvars:st:indices = [0, 1, 2, 0, 2, 1]\n"
        "string primvars:note = \"text\"\n"
        "vector3f[] primvars:wind = [(1, 2, 3)] ( interpolation = \"constant\" )\n";
    const std::string text = kUsdHead + usd_mesh(values + kUsdSquare);
    const MeshFile mesh = mesh_and_fields("a.usda", text, "all");
    CHECK(mesh.warnings.empty());
    CHECK(at_corners(mesh, "heat") == std::vector<double>{1, 2, 3, 1, 3, 4});
    CHECK(at_corners(mesh, "label") == std::vector<double>{7, 7, 7, 8, 8, 8});
    CHECK(at_corners(mesh, "color", 0) == std::vector<double>(6, 1));
    CHECK(at_corners(mesh, "uv", 0) == std::vector<double>{0, 1, 1, 0, 1, 1});
    CHECK(at_corners(mesh, "uv", 1) == std::vector<double>{0, 0, 1, 0, 1, 0});
    CHECK(at_corners(mesh, "wind", 2) == std::vector<double>(6, 3));
    CHECK(mesh.fields.size() == 5);
    // The corners of a mesh that is turned over keep their values.
    const MeshFile left = mesh_and_fields(
        "a.usda",
        kUsdHead + usd_mesh("uniform token orientation = \"leftHanded\"\n" + values + kUsdSquare),
        "heat,uv");
    CHECK(at_corners(left, "heat") == std::vector<double>{1, 3, 2, 1, 4, 3});
    CHECK(at_corners(left, "uv", 1) == std::vector<double>{0, 1, 0, 0, 0, 1});

    // Attributes that some meshes lack are refused if they are named.
    const std::string two = text + usd_mesh(kUsdSquare, "n");
    CHECK(mesh_and_fields("a.usda", two, "all").fields.empty());
    const auto fails = [](const std::string& content, const std::string& fields,
                          std::string_view part) {
        check_fails(ExitCode::bad_input, part, [&] { mesh_and_fields("a.usda", content, fields); });
    };
    fails(two, "heat", "has no value of 'heat'");
    fails(text, "cold", "has no attribute 'cold'; it has heat, label, color, uv and wind");
    const std::string wrong =
        kUsdHead +
        usd_mesh("float[] primvars:heat = [1, 2] ( interpolation = \"vertex\" )\n" + kUsdSquare);
    fails(wrong, "heat", "line 5: prim </m>: 'primvars:heat' has 2 values for 4 elements");
    CHECK(mesh_and_fields("a.usda", wrong, "all").fields.empty());
    fails(kUsdHead + usd_mesh("float[] primvars:heat = [1] ( interpolation = \"vertex\" )\n"
                              "int[] primvars:heat:indices = [0, 0, 1, 0]\n" +
                              kUsdSquare),
          "heat",
          "line 6: prim </m>: 'primvars:heat:indices' has the number 1, which is not from 0");

    const MeshFile painted = geodisk::tools::mesh_of(
        "a.usda", kUsdHead + "def Xform \"w\"\n{\nrel material:binding = </looks/red>\n" +
                      usd_mesh(kUsdSquare + "def GeomSubset \"s\" {\nuniform token elementType = "
                                            "\"point\"\nint[] indices = [0]\n"
                                            "rel material:binding = </looks/blue>\n}\n"
                                            "def GeomSubset \"t\" {\nint[] indices = [1]\n"
                                            "rel material:binding = </looks/blue>\n}\n") +
                      "}\n");
    CHECK(painted.part_names.materials == std::vector<std::string>{"red", "blue"});
    REQUIRE(painted.part_of_triangle.size() == 2);
    CHECK(painted.parts[painted.part_of_triangle[0]].material == 0u);
    CHECK(painted.parts[painted.part_of_triangle[1]].material == 1u);
    REQUIRE(painted.part_names.nodes.size() >= 2);
    CHECK(painted.part_names.nodes[1] == "m");
    CHECK(painted.part_names.node_above[1] == 0u);
}

TEST_CASE("normals of USD are turned with their meshes") {
    MeshSources sources;
    const TemporaryFolder folder;
    sources.mesh =
        folder
            .write("a.usda",
                   kUsdHead + xform("float3 xformOp:scale = (1, 1, -2)\n", "\"xformOp:scale\"",
                                    usd_mesh("normal3f[] normals = [(0, 0, 1), (0, 0, 1), "
                                             "(0, 0, 1), (0, 1, 1)]\n" +
                                             kUsdSquare)))
            .string();
    sources.fields.normals = true;
    const MeshFile mesh = read_mesh(sources);
    REQUIRE(mesh.normals);
    CHECK(mesh.normals->values ==
          std::vector<double>{0, 0, -0.5, 0, 0, -0.5, 0, 0, -0.5, 0, 1, -0.5});
}

TEST_CASE("files that a USD file names are known, so that no output replaces them") {
    const TemporaryFolder folder;
    folder.write("a.png", "");
    folder.write("b@c.png", "");
    const auto mesh = folder.write(
        "a.usda", kUsdHead + "asset x = @./a.png@, @none.png@\nasset y = @@@b@c.png@@@\n");
    const std::vector<Path> files = files_named_in(mesh, "");
    REQUIRE(files.size() == 2);
    CHECK(files[0].filename() == "a.png");
    CHECK(files[1].filename() == "b@c.png");
}

TEST_CASE("holes of USD have no triangles, and faces keep their numbers") {
    const MeshFile mesh = geodisk::tools::mesh_of(
        "a.usda", kUsdHead + usd_mesh("int[] holeIndices = [0]\n" + kUsdSquare));
    CHECK(mesh.triangles == UsdCorners{0, 2, 3});
    CHECK(mesh.polygons == UsdCorners{1});
}

TEST_CASE("what is in other files or places of USD is refused by name") {
    const std::string convert = "bring all into one file: usdcat -f a.usda -o flat.usda";
    for (const char* const entry :
         {"references = @b.usda@", "prepend references = [@b.usda@</a> (offset = 1), @c.usda@]",
          "payload = @b.usd@", "inherits = </a>", "specializes = </a>"}) {
        const std::string mesh = usd_mesh(kUsdSquare, "m", "(\n" + std::string(entry) + "\n)");
        check_usd_refused(mesh, convert);
        check_usd_refused(mesh, "line 2: prim </m> has ");
    }
    check_usd_refused("(\n subLayers = [ @b.usda@ (offset = 1) ]\n)\n",
                      "line 3: the file has sublayers");
    check_usd_refused("def Xform \"x\" (variants = { string v = \"a\" })\n{\nvariantSet \"v\" = { "
                      "\"a\" { } }\n}\n",
                      "line 4: prim </x> has variants, which are not read; " + convert);
    check_usd_refused("def PointInstancer \"p\" { }\n", "line 2: prim </p> is a PointInstancer");
    geodisk::tools::check_refused("a.usdc", "PXR-USDC",
                                  "is a binary USD file; convert it: usdcat -f a.usdc -o a.usda");
    geodisk::tools::check_refused("b.usdz", "PK\3\4", "usdcat -f b.usdz -o b.usda");
    geodisk::tools::check_refused("b.usd", "PXR-USDC", "usdcat -f b.usd -o b.usda");
    geodisk::tools::check_refused("b.usda", "PXR-USDC", "is a binary USD file");
    geodisk::tools::check_refused("a.obj", kUsdHead,
                                  "is a USD file, so its name should end in .usda");
    geodisk::tools::check_refused("a.usda", "ply\n", "is a PLY file");
    geodisk::tools::check_refused("a.usda", "v 0 0 0\n",
                                  "is no text of USD: it does not begin with '#usda'");
    geodisk::tools::check_refused("a.usda", "", "is empty");
    check_usd_refused("", "has no mesh that is shown");
}

TEST_CASE("faults of USD are told with their line") {
    const auto check_mesh = [](const std::string& properties, std::string_view part) {
        check_usd_refused(usd_mesh(properties), part);
    };
    check_mesh("int[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]\n",
               "line 2: prim </m>: has no points");
    check_mesh("point3f[] points = [(0, 0, 0)]\nint[] faceVertexCounts = [3]\n",
               "prim </m>: has no faceVertexIndices");
    check_mesh("point3f[] points = [(0, 0)]\nint[] faceVertexCounts = []\n"
               "int[] faceVertexIndices = []\n",
               "line 5: prim </m>: points has 2 numbers, not three for each");
    const std::string points = "point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n";
    const auto check_faces = [&](const std::string& counts, const std::string& corners,
                                 std::string_view part) {
        check_mesh(points + "int[] faceVertexCounts = [" + counts +
                       "]\nint[] faceVertexIndices = [" + corners + "]\n",
                   part);
    };
    check_faces("3", "0, 1, 3",
                "line 7: prim </m>: 'faceVertexIndices' has the number 3, which is not from 0 to "
                "below 3");
    check_faces("3", "0, 1, -1", "has the number -1");
    check_faces("3", "0, 1, 1.5", "has the number 1.5");
    check_faces("2000000000", "0, 1, 2",
                "line 6: prim </m>: 'faceVertexCounts' has the number 2000000000");
    check_faces("3, 3", "0, 1, 2",
                "line 6: prim </m>: has 3 corners, not as many as faceVertexCounts tells");
    check_faces("2", "0, 1, 2", "has 3 corners, not as many");
    check_faces("-3", "0, 1, 2", "has the number -3");
    check_mesh("point3f[] points = [(0, 0, 0), (nan, 0, 0), (0, 1, 0)]\n"
               "int[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]\n",
               "the coordinates are not finite");
    check_mesh("point3f[] points = [(0, 0, x)]\n", "line 5: 'x' is no value");
    check_mesh("point3f[] points = [(0, 0, 1..2)]\n", "line 5: '1..2' is not a number");
    check_mesh("point3f[] points = [(0, 0, 0]\n", "line 5: ']' is unexpected in a value");
    check_mesh("point3f[] points = [[[[[[[[[[0\n", "values are nested too deeply");
    check_mesh("string a = \"b\n", "line 5: a string has no end");
    check_mesh("int[] a = [1, 2\n", "line 6: the bracket '}' closes none");
    check_mesh("= 3\n", "line 5: '=' is unexpected in prim </m>");
    check_mesh("float[] primvars:a = [1] (\n interpolation \"vertex\"\n)\n",
               "instead of '=' after a key");
    check_mesh("double3 xformOp:translate.timeSamples = { 1 (0, 0, 0) }\n",
               "'(' instead of ':' after the time of a sample");
    check_usd_refused("def Mesh \"m\"\n{\n" + kUsdSquare, "line 2: prim </m> has no end");
    check_usd_refused("def Mesh \"m\" (\n", "the bracket '(' is not closed");
    check_usd_refused("def Mesh\n{\n}\n", "line 3: a prim has no name");
    check_usd_refused("def Mesh \"m\"\n", "the end of the file instead of '{' after the prim </m>");
    check_usd_refused("Mesh \"m\" { }\n", "line 2: 'Mesh' instead of a prim");
    check_usd_refused(std::string("def Mesh \"m\" { \0 }\n", 18), "contains a NUL byte");
    const auto check_order = [](const std::string& operations, const std::string& order,
                                std::string_view part) {
        check_usd_refused(xform(operations, order, usd_mesh(kUsdSquare)), part);
    };
    check_order("", "\"xformOp:translate\"", "prim </x> has no value of 'xformOp:translate'");
    check_order("double3 xformOp:shear = (1, 2, 3)\n", "\"xformOp:shear\"",
                "line 4: 'xformOp:shear' of prim </x> is not translate, scale");
    check_order("double3 xformOp:translate = (1, 2)\n", "\"xformOp:translate\"",
                "is not translate");
    check_order("double3 xformOp:translate = (1, 2, inf)\n", "\"xformOp:translate\"",
                "with finite numbers");
    check_order("float3 xformOp:scale = (0, 1, 1)\n", "\"!invert!xformOp:scale\"",
                "is not invertible");
    check_order("quatf xformOp:orient = (0, 0, 0, 0)\n", "\"xformOp:orient\"", "is not translate");
    std::string deep;
    for (int i = 0; i < 300; ++i) {
        deep += "def Xform \"x\" {\n";
    }
    check_usd_refused(deep, "line 202: prims are nested more than 200 deep");
    const std::string whole = kUsdHead + xform("float3 xformOp:scale = (1, 1, -2)\n",
                                               "\"xformOp:scale\"", usd_mesh(kUsdSquare));
    for (std::size_t size = 0; size + 2 < whole.size(); ++size) {
        geodisk::tools::check_refused("a.usda", whole.substr(0, size), "");
    }
}
