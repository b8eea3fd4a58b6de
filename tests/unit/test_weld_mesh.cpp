// Meshes read with vertices that lie in one place joined.
#include "files/meshes/mesh_file.hpp"
#include "geometry/surface_warnings.hpp"
#include "geometry/vertex_uvs.hpp"
#include "geometry/weld_mesh.hpp"
#include "program/arguments.hpp"
#include "program/failure.hpp"
#include "shapes/builtin_shapes.hpp"

#include "mesh_facts.hpp"
#include "test_files.hpp"

#include <optional>
#include <string>

#include <geodisk/weld.hpp>

using namespace geodisk::tools;

namespace {

MeshFile welded(std::string_view name, std::string_view bytes, const Length& distance,
                bool has_uvs = false) {
    const TemporaryFolder folder;
    MeshSources sources;
    sources.mesh = folder.write(name, bytes).string();
    sources.weld = distance;
    sources.fields.uvs = has_uvs;
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
    CHECK(vertex_uvs(mesh) ==
          std::vector<VertexUv>{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {2, 0, 0}, {5, 0, 0}});
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

TEST_CASE("seams are joined by default, and corners of the file are kept") {
    const TemporaryFolder folder;
    MeshSources sources;
    sources.mesh = folder
                       .write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 -0\nv 1 1 0\nv 0 1 0\n"
                                       "f 1 2 3\nf 4 5 6\n")
                       .string();
    const MeshFile mesh = read_mesh(sources);
    CHECK(mesh.triangles == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 5});
    CHECK(mesh.corners_in_file() == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5});
    REQUIRE(mesh.weld);
    CHECK(mesh.weld->joined_edges == 2);
    CHECK(mesh.weld->merged_vertices == 2);
    CHECK(mesh.warnings.empty());
    CHECK(values_at_vertices(mesh, {1, 2, 3, 2, 5, 6}) ==
          std::vector<double>{1.5, 2, 4, 1.5, 4, 6});
    sources.keep_seams = true;
    const MeshFile kept = read_mesh(sources);
    CHECK(kept.triangles == kept.corners_in_file());
    CHECK_FALSE(kept.weld);
    CHECK(values_at_vertices(kept, {1, 2}) == std::vector<double>{1, 2});
}

TEST_CASE("no built-in shape has seams") {
    for (const BuiltinShape& shape : builtin_shapes()) {
        CAPTURE(shape.name);
        const MeshFile mesh = make_builtin(shape.name, std::nullopt);
        CHECK(take(geodisk::join_seams({mesh.positions, mesh.triangles, mesh.dimension}))
                  .joined_edges == 0);
    }
}

TEST_CASE("near misses in a part that is tiny beside the whole") {
    const TemporaryFolder folder;
    const auto told = [&](const std::string& size) {
        MeshSources sources;
        const std::string plate =
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 1 1e-16 0\nv 0 1 1e-16\nf 1 2 3\nf 5 4 6\n";
        const std::string body = "v 2 2 2\nv " + size + " 2 2\nv 2 " + size + " 2\nv 2 2 " + size +
                                 "\nf 7 9 8\nf 7 8 10\nf 8 9 10\nf 9 7 10\n";
        sources.mesh = folder.write("a.obj", plate + body).string();
        const MeshFile mesh = read_mesh(sources);
        for (const MeshWarning& warning : surface_warnings(
                 mesh, take(geodisk::PreparedMesh::prepare({mesh.positions, mesh.triangles, 3})))) {
            if (warning.kind == "near_seams") {
                return warning.message;
            }
        }
        return std::string();
    };
    CHECK(contains(told("1000"),
                   "2 edges nearly coincide but are not connected, up to 1e-16 apart: "
                   "spacing is not kept across them. --weld=1e-9 joins them"));
    CHECK(contains(told("1e14"), "spacing is not kept across them. The gap is too small for --weld "
                                 "beside the size of the mesh; give both sides the same"));
}

TEST_CASE("near misses name the distance that joins them") {
    struct Case {
        const char* vertex; // What should be 1 1 0.
        const char* told;   // "" for nothing.
    };
    const std::string rest = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 0\n";
    const Case cases[] = {
        {"1 1 1e-7", "--weld=1e-6 joins them"},       {"1.00000017 1 0", "up to 1.7e-07 apart"},
        {"1.00000017 1 0", "--weld=1e-6 joins them"}, {"1 1 1e-5", "--weld=1e-4 joins them"},
        {"1 1 1e-16", "--weld=1e-12 joins them"},     {"1 1 0.001", ""}};
    for (const Case& near : cases) {
        CAPTURE(near.vertex);
        const TemporaryFolder folder;
        MeshSources sources;
        sources.mesh =
            folder.write("a.obj", rest + "v " + near.vertex + "\nf 1 2 3\nf 5 6 4\n").string();
        const auto told = [&] {
            const MeshFile mesh = read_mesh(sources);
            std::string text;
            for (const MeshWarning& warning : surface_warnings(
                     mesh,
                     take(geodisk::PreparedMesh::prepare({mesh.positions, mesh.triangles, 3})))) {
                text += warning.kind == "near_seams" ? warning.message : "";
            }
            return text;
        };
        const std::string text = told();
        CHECK(contains(text, near.told));
        CHECK(text.empty() == std::string(near.told).empty());
        if (const std::size_t at = text.find("--weld="); at != std::string::npos) {
            sources.weld = parse_length("--weld", text.substr(at + 7, text.find(' ', at) - at - 7));
            CHECK(told().empty());
            CHECK(read_mesh(sources).triangles == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
        }
    }
}
