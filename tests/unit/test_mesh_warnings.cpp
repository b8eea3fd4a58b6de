// Warnings about meshes whose faces hang together in odd ways.
#include "files/meshes/mesh_file.hpp"
#include "geometry/surface_warnings.hpp"
#include "test_files.hpp"

#include <string>
#include <vector>

using namespace geodisk::tools;

namespace {

using Lines = std::vector<std::string>;

/// Kind, count and place of all that is told of an OBJ with these faces over eight vertices, no
/// three of them in line.
Lines told(const std::string& faces, bool has_normals = false) {
    const TemporaryFolder folder;
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 0\nv 1 0 1\nv 0 1 1\n"
                                 "v 2 3 5\n";
    const MeshFile mesh = read_mesh(folder.write("a.obj", vertices + faces).string());
    const geodisk::PreparedMesh prepared =
        take(geodisk::PreparedMesh::prepare({mesh.positions, mesh.triangles}));
    Lines lines;
    for (const MeshWarning& warning : surface_warnings(mesh, prepared, has_normals)) {
        lines.push_back(warning.kind + " " + std::to_string(warning.count) +
                        (warning.first.empty() ? "" : " " + warning.first));
    }
    return lines;
}

} // namespace

TEST_CASE("faces side by side are nothing to tell of") {
    CHECK(told("f 1 2 3\nf 3 2 5\n").empty());
    CHECK(told("f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n").empty());
}

TEST_CASE("edges of three faces, of two that are turned over, and both") {
    CHECK(told("f 1 2 3\nf 3 2 5\nf 4 3 2\n") == Lines{"nonmanifold_edges 1 line 9"});
    CHECK(told("f 3 2 5\nf 1 3 2\n") == Lines{"inconsistent_orientation 1 line 9"});
    CHECK(told("f 3 2 5\nf 1 3 2\nf 1 2 4\nf 1 2 6\n") ==
          Lines{"nonmanifold_edges 1 line 10", "inconsistent_orientation 1 line 9"});
}

TEST_CASE("vertices that join parts without a common edge") {
    CHECK(told("f 1 2 3\nf 1 4 6\n") == Lines{"bow_tie_vertices 1 line 1, vertex 1"});
    // Faces around an edge of four hang together by it, also at its ends.
    CHECK(told("f 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 2 6\n") == Lines{"nonmanifold_edges 1 line 9"});
    CHECK(told("f 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 7 8\n") ==
          Lines{"nonmanifold_edges 1 line 9", "bow_tie_vertices 1 line 1, vertex 1"});
    // Two parts that touch twice.
    CHECK(told("f 1 2 3\nf 1 3 4\nf 2 7 8\nf 4 8 7\n") ==
          Lines{"bow_tie_vertices 2 line 2, vertex 2"});
}

TEST_CASE("parts that do not touch") {
    CHECK(told("f 1 2 3\nf 4 6 7\n") == Lines{"components 2"});
}

TEST_CASE("what normals have to do with turned faces") {
    const TemporaryFolder folder;
    const MeshFile mesh = read_mesh(
        folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 3 4\n").string());
    const geodisk::PreparedMesh prepared =
        take(geodisk::PreparedMesh::prepare({mesh.positions, mesh.triangles}));
    for (const bool has_normals : {false, true}) {
        const auto warnings = surface_warnings(mesh, prepared, has_normals);
        REQUIRE(warnings.size() == 1);
        CHECK(contains(warnings[0].message, "pulls them apart") == has_normals);
    }
}
