// VTK's legacy files.
#include "array_facts.hpp"
#include "files/byte_order.hpp"
#include "mesh_bytes.hpp"
#include "test_files.hpp"

#include <algorithm>
#include <initializer_list>
#include <string>

using namespace geodisk::tools;

namespace {

using VtkCorners = std::vector<std::uint32_t>;

std::string vtk_text(const std::string& body, const std::string& version = "3.0") {
    return "# vtk DataFile Version " + version + "\na title\nASCII\n" + body;
}

const std::string kSquare = "DATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0\n1 1 0 0 1 0\n";

/// Numbers as binary files have them.
template <class Number>
std::string big(std::initializer_list<Number> numbers) {
    std::string bytes;
    for (Number number : numbers) {
        char raw[sizeof number];
        store_little_endian(raw, number);
        std::reverse(raw, raw + sizeof raw);
        bytes.append(raw, sizeof raw);
    }
    return bytes;
}

} // namespace

TEST_CASE("polygons and strips of VTK become faces, in the order of their arrays") {
    const std::string strips = "TRIANGLE_STRIPS 1 5\n4 0 1 3 2\n",
                      polygons = "POLYGONS 1 4\n3 0 1 2\n";
    for (const std::string& body : {strips + polygons, polygons + strips}) {
        const MeshFile mesh = mesh_and_fields(
            "a.vtk",
            vtk_text(kSquare + "VERTICES 1 2\n1 0\nLINES 2 6\n2 0 1 2 1 2\n" + body +
                     "CELL_DATA 5\nSCALARS cell int\nLOOKUP_TABLE default\n10 11 12 13 14\n"),
            "all");
        CHECK(mesh.triangles == VtkCorners{0, 1, 2, 0, 1, 3, 3, 1, 2});
        CHECK(values_of(mesh, "cell") == std::vector<double>{13, 14, 14});
        CHECK(mesh.warnings.empty());
    }
}

TEST_CASE("cells of VTK's version 5 are offsets and corners") {
    const MeshFile mesh =
        mesh_of("a.vtk", vtk_text(kSquare + "METADATA\nINFORMATION 0\n\nPOLYGONS 3 7\n"
                                            "OFFSETS vtktypeint64\n0 3 7\n"
                                            "CONNECTIVITY vtktypeint64\n0 1 3 0 1 2 3\n",
                                  "5.1"));
    CHECK(mesh.triangles == VtkCorners{0, 1, 3, 0, 1, 2, 0, 2, 3});
    CHECK(mesh.polygons == VtkCorners{0, 1, 1});
}

TEST_CASE("binary VTK has the highest byte first") {
    const std::string head = "# vtk DataFile Version 2.0\ntitle\nBINARY\nDATASET POLYDATA\n";
    const std::string bytes =
        head + "POINTS 3 double\n" + big<double>({0, 0, 0, 1, 0, 0, 0, 1, 0.5}) +
        "\nPOLYGONS 1 4\n" + big<std::int32_t>({3, 0, 1, 2}) + "\nPOINT_DATA 3\nFIELD data 3\n" +
        "name 1 2 string\n\xc3"
        "a%0\xc1"
        "b\ntwo%20words 2 3 short\n" +
        big<std::int16_t>({1, 2, 3, 4, 5, -6}) +
        "\nMETADATA\nCOMPONENT_NAMES\na\nb\n\nbits 1 3 bit\n" +
        "\xa0\nCOLOR_SCALARS paint 3\n\xff" + std::string("\0\0\0\x33\0\0\0\xff", 8) + "\n";
    const MeshFile mesh = mesh_and_fields("a.vtk", bytes, "all");
    CHECK(mesh.positions == std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0.5});
    CHECK(values_of(mesh, "two_words") == std::vector<double>{1, 2, 3, 4, 5, -6});
    CHECK(values_of(mesh, "bits") == std::vector<double>{1, 0, 1});
    CHECK(values_of(mesh, "color") == std::vector<double>{1, 0, 0, 0, 0.2, 0, 0, 0, 1});
}

TEST_CASE("attributes of VTK are those that samples and options can have") {
    const std::string text = vtk_text(
        kSquare +
        "POLYGONS 1 5\n4 0 1 2 3\nPOINT_DATA 4\nSCALARS heat double 1\n"
        "LOOKUP_TABLE table\n1 2 3 4\nLOOKUP_TABLE table 1\n0 0 0 1\n"
        "VECTORS wind float\n1 0 0 2 0 0 3 0 0 4 0 0\n"
        "NORMALS n float\n0 0 1 0 0 1 0 0 1 0 0 1\n"
        "TEXTURE_COORDINATES t 2 float\n0 0 1 0 1 1 0 1\n"
        "SCALARS paint unsigned_char 3\nLOOKUP_TABLE default\n255 0 0 0 255 0 0 0 255 51 0 0\n"
        "CELL_DATA 1\nSCALARS heat int\nLOOKUP_TABLE default\n7\n");
    const MeshFile mesh = mesh_and_fields("a.vtk", text, "all");
    CHECK(values_of(mesh, "heat") == std::vector<double>{1, 2, 3, 4});
    CHECK(values_of(mesh, "face_heat") == std::vector<double>{7});
    CHECK(values_of(mesh, "wind").size() == 12);
    CHECK(values_of(mesh, "uv").size() == 8);
    CHECK(values_of(mesh, "color")[9] == doctest::Approx(0.2));
    CHECK(mesh.warnings.empty());

    const TemporaryFolder folder;
    MeshSources sources;
    sources.mesh = folder.write("a.vtk", text).string();
    sources.fields.numbers = {"wind_0", "color"};
    sources.fields.normals = true;
    const MeshFile numbers = read_mesh(sources);
    CHECK(numbers.numbers.at(0).values == std::vector<double>{1, 2, 3, 4});
    CHECK(numbers.normals->values.size() == 12);
    CHECK(numbers.fields.empty());
}

TEST_CASE("a grid of VTK is read if its cells are faces") {
    const std::string grid =
        "DATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0\n0 1 0 1 1 0\n";
    const MeshFile mesh =
        mesh_of("a.vtk", vtk_text(grid + "CELLS 4 15\n2 0 1\n4 0 1 2 3\n3 0 1 2\n2 1 0\n"
                                         "CELL_TYPES 4\n3 8 5 3\n"));
    CHECK(mesh.triangles == VtkCorners{0, 1, 3, 0, 3, 2, 0, 1, 2});
    geodisk::tools::check_refused("a.vtk",
                                  vtk_text(grid + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n"),
                                  "a.vtk: cell 0 is a tetrahedron; of a grid, triangles");
    geodisk::tools::check_refused("a.vtk",
                                  vtk_text(grid + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n77\n"),
                                  "cell 0 is a cell of type 77");
    geodisk::tools::check_refused("a.vtk",
                                  vtk_text(grid + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 2\n9 9\n"),
                                  "2 types of cells for 1 cell");
}

TEST_CASE("faults of VTK's files are told with their place") {
    const auto check = [](const std::string& body, std::string_view part) {
        geodisk::tools::check_refused("a.vtk", vtk_text(body), part);
    };
    geodisk::tools::check_refused("a.vtk", "", "a.vtk: is empty");
    geodisk::tools::check_refused("a.vtk", "v 0 0 0\n", "is not a VTK file");
    geodisk::tools::check_refused("a.vtk", "<?xml version=\"1.0\"?>\n<VTKFile>",
                                  "so its name should end in .vtp");
    geodisk::tools::check_refused("a.off", vtk_text(kSquare), "if its name ends in .vtk");
    geodisk::tools::check_refused("a.vtk", "# vtk DataFile Version 7.0\n",
                                  "version '7.0' is none of");
    geodisk::tools::check_refused("a.vtk", "# vtk DataFile Version 3.0\n\nHEX\n",
                                  "line 3: ASCII or BINARY");
    check("DATASET STRUCTURED_GRID\n", "line 4: a dataset 'STRUCTURED_GRID' is no surface");
    check("POINTS 1 float\n", "line 4: the line DATASET TYPE");
    check(kSquare, "has no faces");
    check(kSquare + "CUBES 1 2\n", "line 8: unknown section 'CUBES'");
    check("DATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 x\n1 1 0 0 1 0\n",
          "line 6: 'x' is not a number");
    check("DATASET POLYDATA\nPOINTS 4 quad\n", "line 5: unknown type of numbers 'quad'");
    check("DATASET POLYDATA\nPOINTS 4\n", "line 5: the line of 'POINTS' has too few words");
    check("DATASET POLYDATA\nPOINTS 4000000000 float\n0 0 0\n",
          "line 5: 12,000,000,000 numbers are expected, and the file ends before");
    check("DATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 1 1\n", "9 numbers are expected");
    check("DATASET POLYDATA\nPOINTS -3 float\n", "'-3' is not a number of elements");
    check(kSquare + "POLYGONS 1 4\n3 0 1 4\n", "cell 0: vertex index 4 is out of range");
    check(kSquare + "POLYGONS 1 4\n3 0 1 -1\n", "cell 0: vertex index -1 is out of range");
    check(kSquare + "POLYGONS 1 4\n9 0 1 2\n", "cell 0 has more corners than are left");
    check(kSquare + "POLYGONS 9 4\n3 0 1 2\n", "cell 1 has more corners than are left");
    check(kSquare + "POLYGONS 1 5\n3 0 1 2 3\n", "1 cell has 4 of 5 numbers");
    check(kSquare + "POLYGONS 1 4\n3 0 1 2\nPOLYGONS 1 4\n3 0 1 2\n", "for the second time");
    check(kSquare + "POLYGONS 1 4\n3 0 1 2\nSCALARS a float\n", "a line LOOKUP_TABLE");
    check(kSquare + "POLYGONS 1 4\n3 0 1 2\nVECTORS a float\n", "an attribute before POINT_DATA");
    check(kSquare + "POLYGONS 1 4\n3 0 1 2\nPOINT_DATA 4\nFIELD f 1\na 4000000000 4 int\n",
          "4 rows of 4,000,000,000 numbers are expected");
    const std::string five = kSquare + "POLYGONS 2 3\n";
    geodisk::tools::check_refused("a.vtk", vtk_text(five, "5.1"), "a line of offsets is expected");
    geodisk::tools::check_refused(
        "a.vtk",
        vtk_text(five + "OFFSETS vtktypeint64\n0 4\nCONNECTIVITY vtktypeint64\n0 1 2\n", "5.1"),
        "the offsets of cells are not those of 3 corners");
    geodisk::tools::check_refused(
        "a.vtk",
        vtk_text(kSquare + "POLYGONS 3 3\nOFFSETS int\n0 9 3\nCONNECTIVITY int\n0 1 2\n", "5.1"),
        "cell 0: its corners end at 9");
    geodisk::tools::check_refused(
        "a.vtk", "# vtk DataFile Version 2.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 3 float\nabc",
        "byte 53: 9 numbers are expected");
    const std::string wrong = vtk_text(kSquare + "POLYGONS 1 4\n3 0 1 2\nPOINT_DATA 3\n"
                                                 "SCALARS heat float\nLOOKUP_TABLE d\n1 2 3\n");
    check_fails(ExitCode::bad_input, "'heat' has 3 numbers for 4 points",
                [&] { mesh_and_fields("a.vtk", wrong, "heat"); });
    const MeshFile left = mesh_and_fields("a.vtk", wrong, "all");
    CHECK(left.fields.empty());
    REQUIRE(left.warnings.size() == 2); // And a vertex that is in no face.
    CHECK(contains(left.warnings[0].message + left.warnings[1].message, "'heat' is left out"));
}
