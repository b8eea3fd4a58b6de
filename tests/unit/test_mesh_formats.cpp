// Particulars of each format of mesh files.
#include "files/meshes/mesh_file.hpp"

#include "mesh_bytes.hpp"
#include "mesh_facts.hpp"
#include "test_files.hpp"

#include <string>

using namespace geodisk::tools;

namespace {

/// The only warning of a mesh.
MeshWarning warning_of(const MeshFile& mesh) {
    REQUIRE(mesh.warnings.size() == 1);
    return mesh.warnings[0];
}

using FormatCorners = std::vector<std::uint32_t>;

constexpr std::string_view kFacet = "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n"
                                    "  vertex 1 0 0\n  vertex 1 1 0\n endloop\nendfacet\n";
constexpr std::string_view kOther = "FACET NORMAL 0 0 1\n OUTER LOOP\n  VERTEX 0 0 0\n"
                                    "  VERTEX 1 1 0\n  VERTEX 0 1 -0\n ENDLOOP\nENDFACET\n";

std::string ascii_stl(std::string_view facets) {
    return "solid part\n" + std::string(facets) + "endsolid part\n";
}

/// Two facets, a unit square, with `header` before them.
std::string binary_stl(std::string header, std::uint32_t count = 2) {
    header.resize(80, ' ');
    const float facets[2][12] = {{0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0},
                                 {0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1, 0}};
    std::string bytes = header;
    for (int i = 0; i < 4; ++i) {
        bytes += static_cast<char>(count >> 8 * i);
    }
    for (const auto& facet : facets) {
        bytes.append(reinterpret_cast<const char*>(facet), sizeof facet);
        bytes.append("\x12\x34");
    }
    return bytes;
}

} // namespace

TEST_CASE("OBJ vertices of two coordinates lie at z = 0") {
    const TemporaryFolder folder;
    const MeshFile mesh =
        read_mesh(folder.write("a.obj", "v 0 1\nv 2 3\nv 4 6\nf 1 2 3\n").string());
    CHECK(mesh.positions == std::vector<double>{0, 1, 0, 2, 3, 0, 4, 6, 0});
    for (const auto& [bytes, part] :
         {std::pair{"v 0 1 2\nv 2 3\nf 1 2 1\n", "line 2: a vertex needs 3 coordinates"},
          {"v 0 1\nv 2 3 4\nf 1 2 1\n", "line 2: has 3 coordinates, but vertices before have 2"}}) {
        const std::string path = folder.write("b.obj", bytes).string();
        check_fails(ExitCode::bad_input, part, [&] { read_mesh(path); });
    }
}

TEST_CASE("STL facets hang together where their vertices lie in one place") {
    for (const std::string& bytes :
         {ascii_stl(std::string(kFacet) + std::string(kOther)), binary_stl("made by a test"),
          binary_stl("solid that is binary all the same")}) {
        const MeshFile mesh = mesh_of("a.STL", bytes);
        CHECK(mesh.positions.size() == 12); // Of places.
        CHECK(mesh.triangles == FormatCorners{0, 1, 2, 0, 2, 3});
        CHECK(mesh.joined.empty());
        CHECK(mesh.polygons.empty());
        CHECK(mesh.warnings.empty());
        CHECK(mesh.weld->merged_vertices == 2);
    }
}

TEST_CASE("binary STL that begins with solid is told by the zeros of its head") {
    std::string bytes = binary_stl("solid part") + "more"; // Not of the size that it tells.
    const MeshFile mesh = mesh_of("a.stl", bytes);
    CHECK(mesh.triangles == FormatCorners{0, 1, 2, 0, 2, 3});
    CHECK(warning_of(mesh).kind == "trailing_data");
    const MeshFile apart =
        mesh_of("a.stl", "solid x\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                         "vertex 0 1 0\nend loop\nEND FACET\nend solid\n");
    CHECK(apart.triangle_count() == 1);
}

TEST_CASE("a text STL that may be cut short is told") {
    const MeshFile mesh = mesh_of("a.stl", "solid part\n" + std::string(kFacet));
    CHECK(mesh.triangle_count() == 1);
    CHECK(warning_of(mesh).kind == "cut_short");
    CHECK(contains(warning_of(mesh).message, "not ended by endsolid"));
}

TEST_CASE("STL facets keep their numbers where they vanish") {
    const std::string point = "facet\nvertex 1 1 1\nvertex 1 1 1\nvertex 2 1 1\nendfacet\n";
    const std::string copies = std::string(kFacet) + std::string(kFacet);
    const MeshFile mesh = mesh_of("a.stl", ascii_stl(point + copies));
    CHECK(mesh.triangle_count() == 3);
    CHECK(mesh.weld->degenerate_faces == 1);
    CHECK(mesh.takes_part(1));
    CHECK(taking_part(mesh) == 1);
    CHECK(warning_of(mesh).first == "line 14");
}

TEST_CASE("faults of STL files are told with their place") {
    const auto check = [](const std::string& facets, std::string_view part) {
        check_refused("a.stl", ascii_stl(facets), part);
    };
    check("", "has no faces");
    check("facet\nvertex 0 0 0\nvertex 1 0 x\n", "a.stl: line 4: 'x' is not a number");
    check("facet\nvertex 0 0 0\nvertex 1 0\n", "line 4: a vertex is three numbers");
    check("facet\nvertex 0 0 0\nendfacet\n", "line 4: a facet has three vertices, not 1");
    check("facet\nvertex 0 0 0\nfacet\n", "line 4: a facet begins inside");
    check("facet\nvertex 0 0 0\n", "line 4: a facet is not ended");
    check("vertex 0 0 0\n", "line 2: a vertex is outside");
    check("endfacet\n", "line 2: no facet");
    check("fascet\n", "line 2: unknown record 'fascet'");
    check("facet\nvertex 0 0 0\nvertex 1 0 nan\nvertex 1 1 1\nendfacet\n", "line 4, vertex 1");
    check(std::string(kFacet) + std::string(1, '\0'), "line 9: contains a NUL");
    check_refused("a.stl", "v 0 0 0\n", "is not an STL file");
    check_refused("a.stl", "", "is empty");
    check_refused("a.stl", binary_stl("x", 3), "facet 2: the file ends");
    check_refused("a.stl", binary_stl("x", 0xffffffffu), "more facets than can be numbered");
    const MeshFile more = mesh_of("a.stl", binary_stl("x", 1));
    CHECK(more.triangle_count() == 1);
    CHECK(warning_of(more).kind == "trailing_data");
    MeshSources sources;
    sources.mesh = "a.stl";
    sources.edge_lengths = "b.txt";
    check_fails(ExitCode::usage, "--edge-lengths needs numbers", [&] { read_mesh(sources); });
}

TEST_CASE("OFF files are read whatever follows the coordinates and corners") {
    const FormatCorners expected{0, 1, 2, 0, 2, 3, 0, 2, 1};
    const MeshFile plain =
        mesh_of("a.off", "OFF # a square\n4 2 5\n\n0 0 0\n1 0 0\n1 1 0 # c\n0 1 0\n"
                         "4 0 1 2 3\n3 1 3 0 255 0 0\n");
    CHECK(plain.triangles == FormatCorners{0, 1, 2, 0, 2, 3, 1, 3, 0});
    CHECK(plain.polygons == FormatCorners{0, 0, 1});
    CHECK(plain.warnings.empty());
    for (const std::string header :
         {"COFF 3 1 0", "NOFF\r\n3 1", "STCNOFF\n3\t1 0", "NCOFF 3 1 0", "OFF 3 1 0"}) {
        CAPTURE(header);
        const MeshFile mesh =
            mesh_of("a.off", header + "\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2\n");
        CHECK(mesh.triangles == FormatCorners{0, 1, 2});
        CHECK(mesh.positions == std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0});
    }
}

TEST_CASE("records of OFF and ASCII PLY files may go on over further lines") {
    const MeshFile off = mesh_of("a.off", "OFF\n4 2 0\n0 0\n0\n1 0 0\n1 1 0\n0\n1\n0\n"
                                          "4 0\n1\n2 \n3\n3 1 3 0\n");
    CHECK(off.triangles == FormatCorners{0, 1, 2, 0, 2, 3, 1, 3, 0});
    CHECK(off.positions == std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    CHECK(off.warnings.empty());
    const std::string start = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n";
    check_refused("a.off", start + "3 0 1\n3 0 2 1\n", "line 6: the face has fewer than its 3");
    check_refused("a.off", "OFF\n3 1 0\n0 0\n1 0 0\n0 1 0\n", "line 3: a vertex needs 3");

    const std::string header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                               "property float y\nproperty float z\nelement face 1\n"
                               "property list uchar int vertex_indices\nend_header\n";
    const MeshFile ply = mesh_of("a.ply", header + "0 0\n0\n1 0 0\n0\n1\n0\n3\n\n0 1\n2\n");
    CHECK(ply.triangles == FormatCorners{0, 1, 2});
    CHECK(ply.positions == std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0});
    CHECK(ply.warnings.empty());
    check_refused("a.ply", header + "0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                  "record 0: the line has too few");
    check_refused("a.ply", header + "0 0 0\n1 0 0\n0 1 0\n3 0 1\n\n7 8\n",
                  "record 0: the line has too few");
    check_refused("a.ply", header + "0 0 0\n1 0 0\n0 1 0\n9999999 0 1\n", "no room for a list");
}

TEST_CASE("faults of OFF files are told with their line") {
    const std::string start = "OFF\n3 1 0\n0 0 0\n1 0 0\n";
    check_refused("a.off", "", "is empty");
    check_refused("a.off", "v 0 0 0\n", "is not an OFF file");
    check_refused("a.off", "OFF BINARY\n", "line 1: a binary OFF file");
    check_refused("a.off", "4OFF\n", "line 1: '4OFF' has 4-D vertices");
    check_refused("a.off", "OFF\n", "ends before the numbers");
    check_refused("a.off", "OFF\n3 x\n", "line 2: the numbers of");
    check_refused("a.off", "OFF\n3 99999999999\n", "line 2: the numbers of");
    check_refused("a.off", "OFF\n4000000000 4000000000 0\n", "ends before vertex 0");
    check_refused("a.off", start, "ends before vertex 2");
    check_refused("a.off", start + "0 1\n", "line 5: a vertex needs 3");
    check_refused("a.off", start + "0 1 z\n", "line 5: 'z' is not a number");
    check_refused("a.off", start + "0 1 inf\n3 0 1 2\n", "line 5, vertex 2: the coordinates");
    check_refused("a.off", start + "0 1 0\n", "ends before face 0");
    check_refused("a.off", start + "0 1 0\n3 0 1\n", "line 6: the face has fewer than its 3");
    check_refused("a.off", start + "0 1 0\n3 0 1 3\n", "line 6: vertex index '3' is out of range");
    check_refused("a.off", start + "0 1 0\n3 0 1 -1\n", "line 6: vertex index '-1'");
    const MeshFile more = mesh_of("a.off", start + "0 1 0\n3 0 1 2\n\n3 0 2 1\n");
    CHECK(more.triangle_count() == 1);
    CHECK(warning_of(more).kind == "trailing_data");
}

TEST_CASE("OFF headers may hold a dimension, or a count behind the keyword") {
    const MeshFile mesh = mesh_of("a.off", "nOFF 4\n3 1 0\n0 0 0 5\n1 0 0 5\n0 1 0 5\n3 0 1 2\n");
    CHECK(mesh.dimension == 4);
    CHECK(mesh.positions == std::vector<double>{0, 0, 0, 5, 1, 0, 0, 5, 0, 1, 0, 5});
    const std::string rest = "\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const MeshFile glued = mesh_of("a.off", "OFF3 1 0" + rest);
    CHECK(glued.triangles == FormatCorners{0, 1, 2});
    CHECK(warning_of(glued).message ==
          "1 number behind OFF without a blank read as the number of vertices (line 1)");
    check_refused("a.off", "OFF4\n3 1 0" + rest, "points of 4 coordinates (4-D)");
    check_refused("a.off", "nOFF 2\n3 1 0" + rest, "line 1: '2' is no number of coordinates");
    check_refused("a.off", "OFFICE\n", "is not an OFF file");
}

TEST_CASE("files that hold something else say what it is") {
    for (const std::string extension : {".obj", ".off", ".ply", ".stl", ".gltf"}) {
        const auto check = [&](std::string_view bytes, std::string_view part) {
            check_refused("a" + extension, bytes, part);
        };
        check("\x1f\x8b\x08", "is compressed by gzip; decompress it first");
        check("PK\x03\x04", "is a zip archive");
        check("version https://git-lfs.github.com/spec/v1\noid sha256:00\n", "run git lfs pull");
        check("\n<!DOCTYPE html>\n<html>", "is a web page (HTML)");
        check(std::string_view("\xff\xfev\0 \0", 6), "is UTF-16; save it as UTF-8");
        check(std::string_view("v\0 \0", 4), "is UTF-16; save it as UTF-8");
        check(std::string_view("\0v\0 ", 4), "is UTF-16; save it as UTF-8");
        if (extension != ".stl") {
            check("solid a\nfacet normal 0 0 1\n",
                  "is an STL file, so its name should end in .stl");
        }
        if (extension != ".ply") {
            check("ply\nformat ascii 1.0\n", "is a PLY file, so its name should end in .ply");
        }
        if (extension != ".gltf") {
            check("{\"asset\": {}}", "is a glTF file, so its name should end in .gltf");
        }
    }
}

TEST_CASE("texts may begin with a byte order mark and end with NULs") {
    const std::string mark = "\xEF\xBB\xBF";
    const std::string nuls(3, '\0');
    for (const auto& [file_name, text] :
         {std::pair<std::string, std::string>{"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
          {"a.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
          {"a.stl", ascii_stl(kFacet)},
          {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"
                    "property float x\nproperty float y\n"
                    "property float z\nelement face 1\n"
                    "property list uchar int vertex_indices\n"
                    "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"}}) {
        const std::string name = file_name;
        CAPTURE(name);
        CHECK(mesh_of(name, mark + text).triangle_count() == 1);
        const MeshFile padded = mesh_of(name, text + nuls);
        CHECK(padded.triangle_count() == 1);
        CHECK(warning_of(padded).kind == "trailing_data");
        CHECK(warning_of(padded).count == 3);
    }
    check_refused("a.obj", "v 0 0 0\nv 1 0" + nuls + "\n",
                  "line 2: contains a NUL byte at offset 13");
}

TEST_CASE("vertices of no face may have coordinates that are no numbers, however written") {
    for (const std::string number : {"nan", "-nan(ind)", "NaN", "inf", "-Infinity", "1.#IND",
                                     "-1.#IND00", "1.#QNAN0", "1.#INF", "1.#J"}) {
        CAPTURE(number);
        const std::string point = number + " 1 " + number;
        const MeshFile obj =
            mesh_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv " + point + " # so\nf 1 2 3\n");
        CHECK(warning_of(obj).kind == "unused_not_finite");
        const std::string values = "0 0 0\n1 0 0\n0 1 0\n" + point + "\n3 0 1 2\n";
        CHECK(warning_of(mesh_of("a.off", "OFF 4 1 0\n" + values)).kind == "unused_not_finite");
        check_refused("a.obj", "v 0 0 0\nv 1 0 0\nv " + point + "\nf 1 2 3\n",
                      "line 3, vertex 3: the coordinates are not finite");
    }
}

TEST_CASE("OBJ faces of fewer than three corners make no triangle") {
    const MeshFile mesh = mesh_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf\nf 1 2 3\n");
    CHECK(mesh.triangles == FormatCorners{0, 1, 2});
    CHECK(mesh.polygons == FormatCorners{2});
    CHECK(warning_of(mesh).message ==
          "2 faces with fewer than 3 corners make no triangle (first: line 4)");
}

TEST_CASE("OBJ indices that are not used may be out of range") {
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n";
    CHECK(mesh_of("a.obj", vertices + "f 1/1/1 2/2/1 3/3/-1\nvt 0 0\nvt 0 0\nvt 0 0\n")
              .warnings.empty());
    const MeshFile mesh =
        mesh_of("a.obj", vertices + "f 1/1 2/-1 3//2\nf 3/0 2//99999999999999999999 1\nvt 0 0\n");
    CHECK(mesh.warnings[0].kind == "bad_unused_index");
    CHECK(mesh.warnings[0].count == 4);
    CHECK(mesh.warnings[0].first == "line 5");
}

namespace {

std::string ply_of(std::string_view faces, std::string_view records,
                   std::string_view line_end = "\n") {
    const std::string text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                             "property float y\nproperty float z\n" +
                             std::string(faces) + "property list uchar int vertex_indices\n" +
                             "end_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n" + std::string(records);
    std::string result;
    for (const char c : text) {
        result += c == '\n' ? line_end : std::string_view(&c, 1);
    }
    return result;
}

} // namespace

TEST_CASE("PLY names that nobody asks for may repeat") {
    const std::string text =
        ply_of("element face 1\nproperty uchar gap\nproperty uchar gap\n", "0 0 3 0 1 2\n");
    CHECK(mesh_of("a.ply", text).triangles == FormatCorners{0, 1, 2});
    const std::string extra = "element other 1\nproperty int a\n";
    CHECK(
        mesh_of("a.ply", ply_of(extra + extra + "element face 1\n", "1\n2\n3 0 1 2\n")).triangles ==
        FormatCorners{0, 1, 2});
    check_refused("a.ply", ply_of("property float y\nelement face 1\n", "3 0 1 2\n"),
                  "line 7: property 'y' is declared twice");
}

TEST_CASE("PLY lines may end with CR alone") {
    const std::string faces = "element face 2\n", records = "3 0 1 2\n3 0 2 3\n";
    for (const char* const line_end : {"\n", "\r\n", "\r"}) {
        const MeshFile mesh = mesh_of("a.ply", ply_of(faces, records, line_end));
        CHECK(mesh.triangles == FormatCorners{0, 1, 2, 0, 2, 3});
        CHECK(mesh.warnings.empty());
    }
}

TEST_CASE("PLY strips of triangles alternate and begin anew at -1") {
    const MeshFile mesh =
        mesh_of("a.ply", ply_of("element tristrips 2\n", "8 0 1 2 3 -1 3 2 1\n2 0 1\n"));
    CHECK(mesh.triangles == FormatCorners{0, 1, 2, 2, 1, 3, 1, 1, 1});
    CHECK(warning_of(mesh).message == "1 copy of an earlier triangle dropped (triangle 2)");
    check_refused("a.ply", ply_of("element tristrips 1\n", "3 0 1 4\n"),
                  "triangle 0: vertex index 4");
    check_refused("a.ply", ply_of("element tristrips 1\n", "3 0 1 -2\n"),
                  "element tristrips, record 0: vertex index -2");
}

TEST_CASE("PLY lines of the header and values that have no place are ignored, not silently") {
    const MeshFile stray =
        mesh_of("a.ply", ply_of("elephant 4\nelement face 2\n", "3 0 1 2\n3 0 2 3\n"));
    CHECK(warning_of(stray).message == "1 unknown header line ignored (line 7)");
    const MeshFile surplus =
        mesh_of("a.ply", ply_of("element face 2\n", "3 0 1 2 3\n3 0 2 3 0 0\n"));
    CHECK(surplus.triangles == FormatCorners{0, 1, 2, 0, 2, 3});
    CHECK(warning_of(surplus).kind == "surplus_values");
    CHECK(warning_of(surplus).count == 2);
}

TEST_CASE("PLY headers of many properties are read in time, and bounded") {
    std::string header = "element face 1\n";
    for (int i = 0; i < 9000; ++i) {
        header += "property uchar p" + std::to_string(i) + "\n";
    }
    check_refused("a.ply", ply_of(header, "0\n"), "element face, record 0");
    for (int i = 9000; i < 10000; ++i) {
        header += "property uchar p" + std::to_string(i) + "\n";
    }
    check_refused("a.ply", ply_of(header, "0\n"), "more than 10,000");
}
