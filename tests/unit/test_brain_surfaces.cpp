// Surfaces of neuroimaging: GIFTI and FreeSurfer.
#include "array_facts.hpp"
#include "files/base64.hpp"
#include "files/meshes/sidecar_files.hpp"
#include "files/samples/gifti_writer.hpp"
#include "mesh_bytes.hpp"
#include "png_bytes.hpp"
#include "test_files.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using namespace geodisk::tools;

namespace {

/// Big-endian numbers, one after the other.
std::string words(const std::vector<std::int32_t>& numbers) {
    std::string bytes;
    for (const std::int32_t number : numbers) {
        bytes += big_endian(static_cast<std::uint32_t>(number));
    }
    return bytes;
}

/// Four vertices: of the colour 1 2 3, of none, of the colour 4 5 6, and of an unknown one.
const std::string kAnnotated = words({4, 1, 0, 0, 0x030201, 2, 0x060504, 3, 77});
const std::string kOldTable = words({1, 2, 2}) + "t" + '\0' + words({5}) + "left" + '\0' +
                              words({1, 2, 3, 0, 5}) + "right" + words({4, 5, 6, 0});
const std::string kNewTable = words({1, -2, 9, 2}) + "t" + '\0' + words({2, 3, 5}) + "left" + '\0' +
                              words({1, 2, 3, 0, 8, 5}) + "right" + words({4, 5, 6, 0});

using BrainCorners = std::vector<std::uint32_t>;

std::string gifti_array(const std::string& attributes, const std::string& data,
                        const std::string& inside = "") {
    return "<DataArray " + attributes + ">\n" + inside + "<Data>" + data + "</Data></DataArray>\n";
}

std::string gifti(const std::string& arrays) {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!DOCTYPE GIFTI SYSTEM \"gifti.dtd\">\n"
           "<GIFTI Version=\"1.0\">\n" +
           arrays + "</GIFTI>\n";
}

std::string attributes_of(const std::string& intent, const std::string& type, int rows, int columns,
                          const std::string& encoding = "ASCII") {
    return "Intent=\"NIFTI_INTENT_" + intent + "\" DataType=\"NIFTI_TYPE_" + type +
           "\" ArrayIndexingOrder=\"RowMajorOrder\" Dimensionality=\"" + (columns > 1 ? "2" : "1") +
           "\" Dim0=\"" + std::to_string(rows) + "\"" +
           (columns > 1 ? " Dim1=\"" + std::to_string(columns) + "\"" : "") + " Encoding=\"" +
           encoding + "\" Endian=\"BigEndian\"";
}

const std::string kPoints =
    gifti_array(attributes_of("POINTSET", "FLOAT32", 4, 3), "0 0 0 1 0 0\n1 1 0 0 1 0.5");
const std::string kTriangles = gifti_array(attributes_of("TRIANGLE", "INT32", 2, 3), "0 1 2 0 2 3");

std::string freesurfer(std::uint32_t faces = 1) {
    std::string bytes = "\xff\xff\xfe"
                        "made by a test\n\n" +
                        big_endian(3) + big_endian(faces);
    for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.25f}) {
        bytes += big_endian(std::bit_cast<std::uint32_t>(x));
    }
    return bytes + big_endian(0) + big_endian(1) + big_endian(2);
}

} // namespace

TEST_CASE("surfaces of GIFTI are text, base64 or packed") {
    std::string bytes;
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) {
        bytes += big_endian(corner);
    }
    std::string plain, packed;
    append_base64(plain, bytes);
    append_base64(packed, zlib_bytes(bytes));
    const std::string by_column = gifti_array(
        "Intent=\"NIFTI_INTENT_TRIANGLE\" DataType=\"NIFTI_TYPE_INT32\" Dimensionality=\"2\" "
        "ArrayIndexingOrder=\"ColumnMajorOrder\" Dim0=\"2\" Dim1=\"3\" Encoding=\"ASCII\"",
        "0 0 1 2 2 3");
    for (const std::string& triangles :
         {kTriangles, by_column,
          gifti_array(attributes_of("TRIANGLE", "INT32", 2, 3, "Base64Binary"), plain),
          gifti_array(attributes_of("TRIANGLE", "INT32", 2, 3, "GZipBase64Binary"), packed)}) {
        const MeshFile mesh = mesh_of("a.surf.gii", gifti(kPoints + triangles));
        CHECK(mesh.triangles == BrainCorners{0, 1, 2, 0, 2, 3});
        CHECK(mesh.positions == std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.5});
        CHECK(mesh.warnings.empty());
    }
}

TEST_CASE("other arrays of a GIFTI surface are attributes") {
    const std::string name = "<MetaData><MD><Name>Name</Name><Value><![CDATA[thick]]></Value></MD>"
                             "</MetaData>";
    const MeshFile mesh = mesh_and_fields(
        "a.gii",
        gifti(kPoints + kTriangles +
              gifti_array(attributes_of("SHAPE", "FLOAT32", 4, 1), "1 2 3 4", name) +
              gifti_array(attributes_of("LABEL", "INT32", 2, 1), "7 8") +
              gifti_array(attributes_of("SHAPE", "FLOAT32", 9, 1), "1")),
        "all");
    CHECK(mesh.fields.size() == 2);
    CHECK(values_of(mesh, "thick") == std::vector<double>{1, 2, 3, 4});
    CHECK(values_of(mesh, "label") == std::vector<double>{7, 8});
}

TEST_CASE("a GIFTI surface stays where its points are, which is told") {
    const auto matrix = [](const std::string& numbers) {
        return gifti(gifti_array(attributes_of("POINTSET", "FLOAT32", 4, 3),
                                 "0 0 0 1 0 0 1 1 0 0 1 0",
                                 "<CoordinateSystemTransformMatrix><TransformedSpace>there"
                                 "</TransformedSpace><MatrixData>" +
                                     numbers + "</MatrixData></CoordinateSystemTransformMatrix>") +
                     kTriangles);
    };
    CHECK(mesh_of("a.gii", matrix("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1")).warnings.empty());
    const MeshFile mesh = mesh_of("a.gii", matrix("1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1"));
    CHECK(mesh.positions[0] == 0);
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0].message ==
          "transform to 'there' ignored: coordinates are as the file has them");
    geodisk::tools::check_refused("a.gii", matrix("1 0"), "has 2 numbers, not 16");
}

TEST_CASE("faults of GIFTI are told with their line") {
    const auto check = [](const std::string& arrays, std::string_view part) {
        geodisk::tools::check_refused("a.gii", gifti(arrays), part);
    };
    geodisk::tools::check_refused("a.gii", "<VTKFile/>", "line 1: <VTKFile> is not the GIFTI");
    geodisk::tools::check_refused("a.gii", "", "is empty");
    check(kPoints, "has no array of NIFTI_INTENT_TRIANGLE");
    check(kPoints + kPoints + kTriangles, "line 7: <DataArray> is the second array of");
    check(kPoints + gifti_array(attributes_of("TRIANGLE", "INT32", 2, 3), "0 1 2 0 2 9"),
          "line 7: <DataArray> face 1: vertex index 9 is out of range, the file has 4 vertices");
    check(kPoints + gifti_array(attributes_of("TRIANGLE", "INT32", 2, 3), "0 1 2 0 2"),
          "has 5 numbers, not 6");
    check(kPoints + gifti_array(attributes_of("TRIANGLE", "INT32", 2, 4), "0"),
          "has rows of 4 numbers instead of 3");
    check(kPoints + gifti_array(attributes_of("TRIANGLE", "INT32", 2000000000, 3), "0"),
          "has 1 number, not 6,000,000,000");
    check(kPoints +
              gifti_array(attributes_of("TRIANGLE", "INT32", 1000000000, 3, "GZipBase64Binary"),
                          "AAAA"),
          "does not unpack to 12,000,000,000 bytes");
    check(kPoints + gifti_array(attributes_of("TRIANGLE", "INT32", 2, 3, "Base64Binary"), "A"),
          "is no base64");
    check(kPoints + gifti_array(attributes_of("TRIANGLE", "INT32", 2, 3, "Base64Binary"), "AAAA"),
          "has 3 bytes, not 24");
    check(kPoints + gifti_array(attributes_of("TRIANGLE", "INT32", 2, 3, "ExternalFileBinary"), ""),
          "has the Encoding 'ExternalFileBinary', which is not read");
    check(kPoints + gifti_array(attributes_of("TRIANGLE", "RGB24", 2, 3), "0"),
          "unknown DataType 'NIFTI_TYPE_RGB24'");
}

TEST_CASE("FreeSurfer's surfaces are known by their first bytes, or as text by .asc") {
    for (const char* const name : {"lh.white", "pial", "a.inflated"}) {
        const MeshFile mesh = mesh_of(name, freesurfer() + "tags");
        CHECK(mesh.triangles == BrainCorners{0, 1, 2});
        CHECK(mesh.positions == std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0.25});
        CHECK(mesh.warnings.empty());
    }
    const std::string text = "#!ascii version of lh.white\r\n3 1\r\n0 0 0  0\r\n1 0 0 0\r\n"
                             "0 1 0.25 0\r\n0 1 2 0\r\n";
    CHECK(mesh_of("lh.white.asc", text).positions == mesh_of("a", freesurfer()).positions);
    geodisk::tools::check_refused("a.white", text, "unknown mesh format");
    geodisk::tools::check_refused("a", freesurfer().replace(2, 1, "\xff"),
                                  "is a FreeSurfer file of quads or of values");
    geodisk::tools::check_refused("a", freesurfer(2),
                                  "ends after 75 bytes, but 3 vertices and 2 faces end at byte 87");
    geodisk::tools::check_refused("a", freesurfer(0xffffffffu), "no number of faces");
    geodisk::tools::check_refused("a", freesurfer().substr(0, 8),
                                  "the file ends inside its two lines");
    geodisk::tools::check_refused("a", freesurfer().substr(0, 22), "no number of vertices");
    geodisk::tools::check_refused("a.asc", "1 2 3\n", "is no FreeSurfer surface");
    geodisk::tools::check_refused("a.asc", "", "is empty");
    geodisk::tools::check_refused("a.asc", text.substr(0, 50), "the file ends before vertex");
    geodisk::tools::check_refused("a.asc", "#!ascii\n3 1\n0 0\n",
                                  "line 3: has too few numbers for vertex 0");
    geodisk::tools::check_refused("a.asc", "#!ascii\n3 1\n0 0 x\n", "line 3: 'x' is not a number");
    geodisk::tools::check_refused("a.asc", "#!ascii\n3 -1\n", "line 2: '-1' is neither");
    geodisk::tools::check_refused("a.asc", "#!ascii\n4000000000 4000000000\n",
                                  "the file ends before vertex 0");
}

TEST_CASE("values of vertices are those of GIFTI and FreeSurfer") {
    const TemporaryFolder folder;
    const auto check = [&](std::string_view name, const std::string& bytes) {
        CHECK(read_values(folder.write(name, bytes), 3).values == std::vector<double>{0.5, -1, 2});
    };
    const auto fails = [&](std::string_view name, const std::string& bytes, std::string_view part) {
        check_fails(ExitCode::bad_input, part, [&] { read_values(folder.write(name, bytes), 3); });
    };
    const auto curv = [](std::uint32_t count, std::uint32_t each) {
        std::string bytes = "\xff\xff\xff" + big_endian(count) + big_endian(7) + big_endian(each);
        for (const float value : {0.5f, -1.f, 2.f}) {
            bytes += big_endian(std::bit_cast<std::uint32_t>(value));
        }
        return bytes;
    };
    const std::string shape = gifti_array(attributes_of("SHAPE", "FLOAT32", 3, 1), "0.5 -1 2");
    check("lh.curv", curv(3, 1));
    check("a.shape.gii", gifti(shape));
    fails("lh.curv", curv(3, 2), "lh.curv: has 2 values for each vertex; one is read");
    fails("lh.curv", curv(0xffffffffu, 1), "ends after 3 of 4,294,967,295 values");
    fails("lh.curv", curv(3, 1).substr(0, 9), "ends within the head");
    fails("a.gii", gifti(shape + shape), "line 6: <DataArray> is the second array of values");
    fails("a.gii", gifti(kPoints), "has no array of values");
    fails("a.gii", gifti(gifti_array(attributes_of("SHAPE", "FLOAT32", 3, 2), "1")),
          "has 2 values for each vertex");
    fails("a.gii", "<a/>", "is not the GIFTI");
}

TEST_CASE("annotations of FreeSurfer give vertices the numbers of their labels") {
    const TemporaryFolder folder;
    const auto check = [&](const std::string& bytes, double left, double right) {
        const VertexValues read = read_values(folder.write("lh.a.annot", bytes), 4);
        CHECK(read.values == std::vector<double>{left, -1, right, -1});
        CHECK(read.is_whole);
        REQUIRE(read.names.size() == 2);
        CHECK(read.names[0].name == "left");
        CHECK(read.names[0].value == left);
        CHECK(read.names[1].name == "right");
        CHECK(read.names[1].value == right);
    };
    check(kAnnotated + kOldTable, 0, 1);
    check(kAnnotated + kNewTable, 3, 8);
    check(kAnnotated + kNewTable + "more", 3, 8);

    const auto fails = [&](const std::string& bytes, std::string_view part) {
        CAPTURE(part);
        check_fails(ExitCode::bad_input, part,
                    [&] { read_values(folder.write("lh.a.annot", bytes), 4); });
    };
    fails("", "byte 0: the file ends before the number of vertices");
    fails(words({2000000000}), "lh.a.annot: byte 0: the number of vertices is 2000000000, but 4 "
                               "bytes are left");
    fails(words({-2000000000}), "the number of vertices is -2000000000");
    fails(words({1, 1, 0}), "byte 4: vertex 1 is out of range, the file has 1 vertex");
    fails(words({2, 0, 0, 0, 0}), "byte 12: vertex 0 has two labels");
    fails(kAnnotated, "has no colour table, which numbers and names its labels");
    fails(kAnnotated + words({0}), "has no colour table");
    fails(kAnnotated + words({1, -3}), "the colour table has version 3; version 2 is read");
    fails(kAnnotated + words({1, 2000000000}), "the number of labels is 2000000000, but 4 bytes");
    fails(kAnnotated + words({1, -2, 9, 2000000000}),
          "the length of the name of the table is 2000");
    fails(kAnnotated + words({1, -2, 9, 0, 2000000000}), "the number of labels is 2000000000");
    fails(kAnnotated + words({1, -2, 9, 0, 1, -5, 0, 0, 0, 0, 0}), "a label has the number -5");
    for (const std::string& whole : {kAnnotated + kOldTable, kAnnotated + kNewTable}) {
        for (std::size_t size = 0; size < whole.size(); ++size) {
            fails(whole.substr(0, size), "");
        }
    }
}

TEST_CASE("lists of vertices of FreeSurfer are 1 inside and 0 outside") {
    const TemporaryFolder folder;
    const std::string head = "#!ascii label  , from subject a vox2ras=TkReg\n";
    const std::string rows = "2  1.5 -2 3 0.25\r\n0  1 2 3 0\n";
    const std::vector<double> expected{1, 0, 1, 0};
    CHECK(read_values(folder.write("lh.cortex.label", head + "2\n" + rows), 4).values == expected);
    CHECK(read_values(folder.write("any", head + "2\n" + rows), 4).values == expected);
    CHECK(read_values(folder.write("a.label", "# by hand\n2\n2\n\n0\n"), 4).values == expected);
    const VertexValues none = read_values(folder.write("a.label", head + "0\n"), 4);
    CHECK(none.values == std::vector<double>(4, 0));
    CHECK(none.is_whole);
    const auto fails = [&](const std::string& bytes, std::string_view part) {
        CAPTURE(bytes);
        check_fails(ExitCode::bad_input, part,
                    [&] { read_values(folder.write("a.label", bytes), 4); });
    };
    fails("", "ends before its number of vertices");
    fails(head, "ends before its number of vertices");
    fails(head + rows, "line 2: has no number of vertices, as a list of FreeSurfer does");
    fails(head + "-2\n" + rows, "line 2: has no number of vertices");
    fails(head + "4000000000\n" + rows, "ends after 2 of 4,000,000,000 vertices");
    fails(head + "1\n" + rows, "line 4: follows the last of 1 vertex");
    fails(head + "1\n4 0 0 0 0\n", "line 3: vertex 4 is out of range, the mesh has 4 vertices");
    fails(head + "1\n-1 0 0 0 0\n", "line 3: has a point of space instead of a vertex (-1)");
    fails(head + "2\n" + rows.substr(0, rows.size() - 5),
          "line 4: has 3 words, but the first line");
    fails(head + "1\n1.5 0 0 0 0\n", "line 3: '1.5' is not the number of a vertex");
    fails(head + "1\n" + std::string(3, '\0') + "\n", "line 3: contains a NUL byte");
}

TEST_CASE("values of a file become attributes, with the names that it has for them") {
    const TemporaryFolder folder;
    const std::string square = gifti(kPoints + kTriangles);
    folder.write("lh.a.annot", kAnnotated + kNewTable);
    folder.write("b.txt", "0.5\n1\n-1\n2\n");
    MeshSources sources;
    sources.mesh = folder.write("a.surf.gii", square).string();
    const std::string annotation = (folder / "lh.a.annot").string();
    const std::string values = (folder / "b.txt").string();
    sources.fields = parse_fields("file:" + values + ",file:" + annotation);
    sources.fields.numbers = {"file:" + annotation};
    const MeshFile mesh = read_mesh(sources);
    REQUIRE(mesh.fields.size() == 2);
    CHECK(mesh.fields[0].name == "b.txt");
    CHECK_FALSE(mesh.fields[0].is_whole);
    CHECK(values_of(mesh, "b.txt") == std::vector<double>{0.5, 1, -1, 2});
    CHECK(mesh.fields[1].is_whole);
    CHECK(values_of(mesh, "lh.a.annot") == std::vector<double>{3, -1, 8, -1});
    const MeshField& number = mesh.number("file:" + annotation);
    CHECK(number.value_names.size() == 2);
    CHECK(number.values == std::vector<double>{3, -1, 8, -1});

    folder.write("b.txt", "1\n2\n");
    check_fails(ExitCode::bad_input, "b.txt: has 2 values for the 4 vertices of the mesh",
                [&] { read_mesh(sources); });
    sources.fields = parse_fields("file:" + annotation + ",file:" + annotation + "2");
    check_fails(ExitCode::bad_input, "lh.a.annot2", [&] { read_mesh(sources); });
    sources.fields = parse_fields("file:");
    check_fails(ExitCode::bad_input, "has no attribute 'file:'", [&] { read_mesh(sources); });
}

TEST_CASE("a table of labels of GIFTI names values") {
    const TemporaryFolder folder;
    const VertexValues read = read_values(
        folder.write("a.label.gii",
                     gifti("<LabelTable><Label Key=\"0\">none</Label><Label Key=\"7\" Red=\"1\">"
                           "<![CDATA[a & b]]></Label></LabelTable>" +
                           gifti_array(attributes_of("LABEL", "INT32", 3, 1), "7 0 7"))),
        3);
    CHECK(read.values == std::vector<double>{7, 0, 7});
    CHECK(read.is_whole);
    REQUIRE(read.names.size() == 2);
    CHECK(read.names[1].name == "a & b");
    CHECK(read.names[1].value == 7);
}

TEST_CASE("distances and labels of GIFTI read back, and names are text in XML") {
    const TemporaryFolder folder;
    const double infinite = std::numeric_limits<double>::infinity();
    DistanceTable table{{3, 9}, {0.5, infinite, 0.1}, {3, 0, 9}};
    const auto write = [&](const char* name, const auto& body) {
        AtomicFile file(folder / name);
        body(file);
        file.commit();
        return folder / name;
    };
    const auto shape = write("a.shape.gii", [&](AtomicFile& file) {
        write_gifti_distances(file, table, {{"mesh", "a<&>\"'\xff\1.obj"}});
    });
    const VertexValues read = read_values(shape, 3);
    REQUIRE(read.values.size() == 3);
    CHECK(read.values[0] == 0.5);
    CHECK(std::isnan(read.values[1]));
    CHECK(read.values[2] == double{0.1f});
    CHECK_FALSE(read.is_whole);
    CHECK(contains(bytes_of(shape), "<Value>a&lt;&amp;&gt;&quot;'\xc3\xbf .obj</Value>"));

    table.nearest.clear();
    table.distances.resize(6);
    const auto rows =
        write("b.shape.gii", [&](AtomicFile& file) { write_gifti_distances(file, table, {}); });
    CHECK(contains(bytes_of(rows), "NumberOfDataArrays=\"2\""));
    check_fails(ExitCode::bad_input, "is the second array of values",
                [&] { read_values(rows, 3); });

    // More numbers than are written at once.
    std::vector<std::int32_t> keys(200'001);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        keys[i] = static_cast<std::int32_t>(i) - 7;
    }
    const std::vector<GiftiLabel> labels{{0, "???", {}}, {7, "a <b>", {0.25, 0.5, 1, 1}}};
    const VertexValues many = read_values(
        write("a.label.gii", [&](AtomicFile& file) { write_gifti_labels(file, keys, labels, {}); }),
        keys.size());
    CHECK(many.is_whole);
    CHECK(many.values == std::vector<double>(keys.begin(), keys.end()));
    REQUIRE(many.names.size() == 2);
    CHECK(many.names[1].name == "a <b>");
    CHECK(many.names[1].value == 7);
}
