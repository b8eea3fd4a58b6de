#include "files/meshes/mesh_file.hpp"

#include "mesh_bytes.hpp"
#include "mesh_facts.hpp"
#include "test_files.hpp"

#include <filesystem>

using namespace geodisk::tools;

namespace {

constexpr std::string_view kPlyTriangle = "ply\nformat ascii 1.0\n"
                                          "element vertex 3\nproperty float x\n"
                                          "property float y\nproperty float z\n"
                                          "element face 1\n"
                                          "property list uchar int vertex_indices\nend_header\n"
                                          "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string replaced(std::string_view text, std::string_view old_part, std::string_view new_part) {
    std::string result(text);
    const std::size_t at = result.find(old_part);
    REQUIRE(at != std::string::npos);
    return result.replace(at, old_part.size(), new_part);
}

} // namespace

TEST_CASE("read_mesh names what is wrong with a path") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "folder.obj");
    check_fails(ExitCode::bad_input, "no such file",
                [&] { read_mesh((folder / "missing.obj").string()); });
    check_fails(ExitCode::bad_input, "folder",
                [&] { read_mesh((folder / "folder.obj").string()); });
    check_fails(ExitCode::bad_input, "unknown mesh format",
                [&] { read_mesh(folder.write("mesh.3ds", "solid").string()); });
    check_fails(ExitCode::bad_input, "mesh.obj: is empty",
                [&] { read_mesh(folder.write("mesh.obj", "").string()); });
    check_fails(ExitCode::usage, "showpiece", [] { read_mesh("builtin:nonsense"); });
    check_fails(ExitCode::usage, "not a resolution", [] { read_mesh("builtin:cube:x"); });
    check_fails(ExitCode::usage, "must be 1 to", [] { read_mesh("builtin:cube:0"); });
#ifndef _WIN32
    std::filesystem::create_symlink("/dev/zero", folder / "endless.ply");
    check_fails(ExitCode::bad_input, "not a regular file",
                [&] { read_mesh((folder / "endless.ply").string()); });
#endif
}

TEST_CASE("extensions may be in capitals") {
    CHECK(mesh_of("a.PLY", kPlyTriangle).triangles.size() == 3);
    CHECK(mesh_of("a.Obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").triangles.size() == 3);
}

TEST_CASE("OBJ coordinates are exact doubles") {
    const MeshFile mesh = mesh_of("a.obj", "v 10000000.724609375 0.1 -1e-320\n"
                                           "v 123456789.123456789 2.2250738585072014e-308 5e-324\n"
                                           "v 0 1 0\nf 1 2 3");
    CHECK(mesh.positions == std::vector<double>{10000000.724609375, 0.1, -1e-320,
                                                123456789.123456789, 2.2250738585072014e-308,
                                                5e-324, 0, 1, 0});
}

TEST_CASE("OBJ faces are taken in order and split in place") {
    const MeshFile mesh = mesh_of("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\n"
                                           "f -4 -1 -3 # first\nf 1/7 2//9 3/1/1 4/\nf 5 3 2\n");
    // The last face copies the first.
    CHECK(mesh.triangles == std::vector<std::uint32_t>{1, 4, 2, 0, 1, 2, 0, 2, 3, 1, 1, 1});
    CHECK(mesh.polygons == std::vector<std::uint32_t>{0, 1, 1, 2});
    CHECK(mesh.polygon_count == 3);
    REQUIRE(mesh.warnings.size() == 2);
    CHECK(mesh.warnings[0].kind == "bad_unused_index");
    CHECK(mesh.warnings[1].kind == "duplicate_faces");
    CHECK(mesh.warnings[1].first == "line 8");
}

TEST_CASE("OBJ faults are reported with their line") {
    const std::string triangle = "v 0 0 0\nv 1 0 0\r\n\rv 0 1 \\\n 0\n";
    CHECK(mesh_of("a.obj", triangle + "f 1 2 3").triangles.size() == 3);
    check_refused("a.obj", triangle + "f 1 2 4", "a.obj: line 6: vertex index 4");
    check_refused("a.obj", triangle + "# c \\\nf 1 2 a", "line 7: 'a'");
    check_refused("a.obj", triangle + "f 1 2 -4", "line 6");
    check_refused("a.obj", triangle + "f 1 2 3/x", "line 6");
    check_refused("a.obj", triangle + "f 1 2 3/1/1/1", "line 6");
    check_refused("a.obj", triangle + "f 1 2 +3", "line 6");
    check_refused("a.obj", triangle + "f", "has no faces");
    check_refused("a.obj", triangle + "f 1 2 99999999999999999999", "line 6");
    check_refused("a.obj", triangle + "f 1 2 4294967296", "line 6");
    check_refused("a.obj", triangle + "v 1 2\nf 1 2 3", "line 6: a vertex needs 3");
    check_refused("a.obj", triangle + "v 1 2 3 x", "line 6: 'x'");
    check_refused("a.obj", triangle + "v 1 nan 3\nf 1 2 4", "line 6, vertex 4");
}

TEST_CASE("repeated corners are dropped or simplified with one warning") {
    const MeshFile mesh = mesh_of("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                           "f 1 2 2\nf 1 2 3 3\nf 1 1 3 4 1\nf 1 2 1 2\n");
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0].kind == "repeated_vertices");
    CHECK(mesh.warnings[0].count == 4);
    CHECK(mesh.warnings[0].first == "line 5");
    CHECK(mesh.warnings[0].message ==
          "4 faces with a repeated vertex dropped or simplified (first: line 5)");
    CHECK(taking_part(mesh) == 2);
    CHECK(std::vector(mesh.triangles.begin() + 3, mesh.triangles.begin() + 6) ==
          std::vector<std::uint32_t>{0, 1, 2});
    CHECK(mesh.polygons == std::vector<std::uint32_t>{0, 1, 1, 2, 2, 2, 3, 3});
}

TEST_CASE("triangles keep the numbers that the file gives them, whatever is dropped") {
    const MeshFile mesh = mesh_of("a.ply", "ply\nformat ascii 1.0\nelement vertex 5\n"
                                           "property float x\nproperty float y\n"
                                           "property float z\nelement face 8\n"
                                           "property list uchar int vertex_indices\nend_header\n"
                                           "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n"
                                           "3 0 1 2\n2 0 1\n3 2 1 0\n0\n3 1 1 2\n"
                                           "4 3 3 2 0\n3 0 1 4\n4 1 2 3 4\n");
    CHECK(mesh.polygon_count == 8);
    CHECK(mesh.polygons == std::vector<std::uint32_t>{0, 2, 4, 5, 5, 6, 7, 7});
    REQUIRE(mesh.triangle_count() == 8);
    const std::vector<bool> takes_part{true, false, false, true, false, true, true, true};
    for (std::size_t t = 0; t < takes_part.size(); ++t) {
        CAPTURE(t);
        CHECK(mesh.takes_part(t) == takes_part[t]);
    }
    CHECK(mesh_of("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 2\nf 1 2 3\n").polygons.empty());
}

TEST_CASE("PLY headers are read strictly") {
    CHECK(mesh_of("a.ply", kPlyTriangle).triangles == std::vector<std::uint32_t>{0, 1, 2});
    const auto check = [](std::string_view old_part, std::string_view new_part,
                          std::string_view message) {
        check_refused("a.ply", replaced(kPlyTriangle, old_part, new_part), message);
    };
    check("ply\n", "plx\n", "not a PLY file");
    check("1.0", "2.0", "line 2");
    check("vertex 3", "vertex 99999999999999999999", "line 3");
    check("vertex 3", "vertex -3", "line 3");
    check("vertex 3", "vertex 3 3", "line 3");
    check("element face", "element vertex", "declared twice");
    check("float y", "float x", "declared twice");
    check("float y", "real y", "line 5: unknown property type 'real'");
    check("list uchar", "list float", "count");
    check("list uchar int", "list int", "line 8");
    check("element face 1", "elephant 1", "element vertex, record 0");
    check("float z", "float w", "no property z");
    check("vertex_indices", "corners", "vertex_indices");
}

TEST_CASE("PLY records are read strictly") {
    const auto check = [](std::string_view old_part, std::string_view new_part,
                          std::string_view message) {
        check_refused("a.ply", replaced(kPlyTriangle, old_part, new_part), message);
    };
    check("1 0 0\n", "1 0\n", "element vertex, record 1: the line has too few");
    check("1 0 0\n", "1 inf 0\n", "element vertex, record 1");
    check("3 0 1 2", "3 0 1", "element face, record 0");
    check("3 0 1 2", "3 0 1 1.5", "vertex index 1.5");
    check("3 0 1 2", "3 0 1 -1", "vertex index -1");
    check("3 0 1 2", "3 0 1 3", "vertex index 3 is out of range");
    check("3 0 1 2", "-3 0 1 2", "'-3'");
    check("3 0 1 2", "2 0 1", "no face");
    check("3 0 1 2\n", "", "ends inside element face");
}

TEST_CASE("an element without properties cannot stall the reader") {
    const std::string text = replaced(kPlyTriangle, "element face",
                                      "element nothing 18446744073709551615\nelement face");
    CHECK(mesh_of("a.ply", text).triangles.size() == 3);
}

TEST_CASE("a face without area is kept with a warning") {
    const MeshFile mesh = mesh_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv .5 0 0\n"
                                           "f 1 2 3\nf 1 4 2\n");
    CHECK(mesh.triangles.size() == 6);
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0].message ==
          "1 triangle without area kept: paths may lead through it (line 6)");
}
