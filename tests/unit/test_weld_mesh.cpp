// Meshes read with vertices that lie in one place joined.
#include "files/mesh_file.hpp"

#include "mesh_facts.hpp"
#include "test_files.hpp"

#include <string>

using namespace geodisk::tools;

namespace {

MeshFile welded(std::string_view name, std::string_view bytes, const Length& distance,
                bool has_uvs = false) {
    const TemporaryFolder folder;
    MeshSources sources;
    sources.mesh = folder.write(name, bytes).string();
    sources.weld = distance;
    sources.has_uvs = has_uvs;
    return read_mesh(sources);
}

/// A square of two triangles without a common vertex, the second one off by 0.001.
constexpr std::string_view kNear = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0.001\nv 0 1 0\n"
                                   "f 1 2 3\nf 4 5 6\n";

} // namespace

TEST_CASE("vertices in one place become the lowest of them") {
    const MeshFile mesh = welded("a.obj", kNear, {});
    CHECK(mesh.triangles == std::vector<std::uint32_t>{0, 1, 2, 0, 4, 5});
    REQUIRE(mesh.weld);
    CHECK(mesh.weld->merged_vertices == 1);
    CHECK(mesh.weld->degenerate_faces == 0);
    CHECK(mesh.positions.size() == 18);
    CHECK(mesh.warnings.empty()); // The vertex left over is of the file's faces.
}

TEST_CASE("vertices near each other are joined where asked for, by units or by percent") {
    for (const Length& distance : {Length{0.002, false}, Length{0.2, true}}) {
        const MeshFile mesh = welded("a.obj", kNear, distance);
        CHECK(mesh.triangles == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 5});
    }
    CHECK(welded("a.obj", kNear, {0.0005, false}).weld->merged_vertices == 1);
}

TEST_CASE("triangles that vanish keep their numbers, and so do copies that come about") {
    const MeshFile mesh =
        welded("a.obj", std::string(kNear) + "f 1 4 5\nf 6 5 4\nv 0 1 0\nf 7 3 1\n", {0.01, false});
    REQUIRE(mesh.triangle_count() == 5);
    CHECK(taking_part(mesh) == 2);
    CHECK(mesh.takes_part(0));
    CHECK(mesh.takes_part(1));
    CHECK(mesh.weld->degenerate_faces == 1);
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0].kind == "duplicate_faces");
    CHECK(mesh.warnings[0].count == 2);
}

TEST_CASE("texture coordinates of joined vertices are those of one on a seam") {
    const MeshFile mesh = welded("a.obj",
                                 "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\n"
                                 "vt 0 0\nvt 1 0\nf 1/1 2/1 3/1\nf 4/2 5/1 6/1\n",
                                 {}, true);
    CHECK(mesh.uvs == std::vector<VertexUv>{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {2, 0, 0}, {5, 0, 0}});
}

TEST_CASE("what cannot be welded is refused") {
    check_fails(ExitCode::usage, "epsilon is too small", [] {
        welded("a.obj", kNear, {1e-300, false});
    });
    check_fails(ExitCode::bad_input, "has no face with an area", [] {
        welded("a.obj", kNear, {10, false});
    });
    MeshSources sources;
    sources.mesh = "a.obj";
    sources.edge_lengths = "b.txt";
    sources.weld = Length{};
    check_fails(ExitCode::usage, "--weld and --edge-lengths", [&] { read_mesh(sources); });
}
