// OBJ files against tinyobjloader, where that reads all they hold.
#include "files/meshes/mesh_file.hpp"
#include "program/failure.hpp"

#include "mesh_bytes.hpp"
#include "support/data_file.hpp"
#include "test_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#define TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

using namespace geodisk::tools;

namespace {

using Faces = std::vector<std::vector<std::uint32_t>>; ///< The vertices of each, ascending.

struct ObjContent {
    std::vector<double> positions;
    Faces faces;
};

void add_corner(std::vector<std::uint32_t>& face, std::uint32_t vertex) {
    const auto place = std::lower_bound(face.begin(), face.end(), vertex);
    if (place == face.end() || *place != vertex) {
        face.insert(place, vertex);
    }
}

ObjContent by_tinyobjloader(const std::string& text) {
    tinyobj::ObjReaderConfig config;
    config.triangulate = false;
    config.vertex_color = false;
    tinyobj::ObjReader reader;
    REQUIRE(reader.ParseFromString(text, "", config));
    ObjContent content{reader.GetAttrib().vertices, {}};
    for (const tinyobj::shape_t& shape : reader.GetShapes()) {
        auto corner = shape.mesh.indices.begin();
        for (unsigned left : shape.mesh.num_face_vertices) {
            auto& face = content.faces.emplace_back();
            for (; left > 0; --left, ++corner) {
                add_corner(face, static_cast<std::uint32_t>(corner->vertex_index));
            }
        }
    }
    return content;
}

ObjContent content_of(const MeshFile& mesh) {
    ObjContent content{mesh.positions, {}};
    std::optional<std::size_t> last;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const std::size_t face = mesh.polygons.empty() ? t : mesh.polygons[t];
        if (face != last) {
            content.faces.emplace_back();
            last = face;
        }
        for (std::size_t c = 0; c < 3; ++c) {
            add_corner(content.faces.back(), mesh.triangles[3 * t + c]);
        }
    }
    return content;
}

void check_same(const ObjContent& ours, const ObjContent& theirs) {
    REQUIRE(ours.positions.size() == theirs.positions.size());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < ours.positions.size(); ++i) {
        // It rounds more than once on its way from the digits.
        wrong +=
            std::abs(ours.positions[i] - theirs.positions[i]) <= 1e-14 * std::abs(ours.positions[i])
                ? 0u
                : 1u;
    }
    CHECK(wrong == 0);
    CHECK(ours.faces == theirs.faces);
}

/// Files that tinyobjloader reads as something else, and those where a copy that is dropped is no
/// face to compare.
const std::set<std::string> kOtherwise{
    "good_bom.obj",          "good_line_continuation.obj", "good_whitespace.obj",
    "warn_isolated_nan.obj", "warn_duplicate_faces.obj",   "warn_duplicate_flipped.obj"};

} // namespace

TEST_CASE("odd OBJ files hold what tinyobjloader finds in them") {
    std::size_t compared = 0;
    const auto folder = geodisk::test::data_file("bad").value();
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (entry.path().extension() != ".obj" || name.starts_with("err_") ||
            kOtherwise.contains(name)) {
            continue;
        }
        CAPTURE(name);
        MeshFile mesh;
        try {
            MeshSources sources;
            sources.mesh = entry.path().string();
            sources.keep_seams = true; // Corners as the file has them.
            mesh = read_mesh(sources);
        } catch (const UserError&) {
            CHECK(name.starts_with("any_"));
            continue;
        }
        check_same(content_of(mesh), by_tinyobjloader(bytes_of(entry.path())));
        ++compared;
    }
    CHECK(compared > 30);
}

TEST_CASE("a large OBJ file in all forms of numbers and indices holds what tinyobjloader finds") {
    const MeshFile shape = read_mesh("builtin:torus-knot");
    const auto vertices = static_cast<int>(shape.positions.size() / 3);
    std::string text;
    std::array<char, 160> line{};
    for (int v = 0; v < vertices; ++v) {
        const char* const forms[] = {"v %.17g %.17g %.17g\n", "v  %.16f\t%.16f %.16f\r\n",
                                     "v %+.16e %.16E %.16e 1\n"};
        const double* const p = &shape.positions[3 * static_cast<std::size_t>(v)];
        std::snprintf(line.data(), line.size(), forms[v % 3], p[0], p[1], p[2]);
        text += line.data();
    }
    text += "vt 0 1\nvn 0 0 1\n# corners\n";
    for (std::size_t t = 0; t < shape.triangle_count(); ++t) {
        const char* const forms[] = {"f %d %d %d\n", "f %d/1 %d/1/1 %d/-1/1\n",
                                     "f  %d//1\t%d//-1  %d//1 \r\ng more\n"};
        // From the first vertex on, else back from the last.
        const int base = t % 5 < 3 ? 1 : -vertices;
        const auto corner = [&](std::size_t c) {
            return base + static_cast<int>(shape.triangles[3 * t + c]);
        };
        std::snprintf(line.data(), line.size(), forms[t % 3], corner(0), corner(1), corner(2));
        text += line.data();
    }
    const MeshFile mesh = mesh_of("knot.obj", text);
    CHECK(mesh.triangles == shape.triangles);
    check_same(content_of(mesh), by_tinyobjloader(text));
}
