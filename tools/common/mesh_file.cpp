#include "common/mesh_file.hpp"

#include "common/builtin_shapes.hpp"
#include "common/file_input.hpp"
#include "common/obj_reader.hpp"
#include "common/ply_reader.hpp"
#include "common/polygon_mesh.hpp"
#include "common/polygon_triangulation.hpp"
#include "common/text.hpp"
#include "common/user_error.hpp"
#include "common/vec3.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>

namespace geodisk::tools {

namespace {

using Path = std::filesystem::path;

bool is_finite(const PolygonMesh& mesh, std::size_t vertex) {
    const double* p = &mesh.positions[3 * vertex];
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

/// OBJ users count vertices from 1 and look for lines, PLY users count records from 0.
[[noreturn]] void fail_index(const Path& path, const PolygonMesh& mesh, std::size_t face,
                             std::uint32_t vertex) {
    const bool has_lines = !mesh.face_lines.empty();
    const std::string place = has_lines ? "line " + std::to_string(mesh.face_lines[face])
                                        : "element face, record " + std::to_string(face);
    fail_input(path, place + ": vertex index " +
                         std::to_string(std::uint64_t{vertex} + (has_lines ? 1u : 0u)) +
                         " is out of range, the file has " +
                         std::to_string(mesh.positions.size() / 3) + " vertices");
}

[[noreturn]] void fail_not_finite(const Path& path, const PolygonMesh& mesh, std::size_t vertex) {
    const std::string place = mesh.vertex_lines.empty()
                                  ? "element vertex, record " + std::to_string(vertex)
                                  : "line " + std::to_string(mesh.vertex_lines[vertex]) +
                                        ", vertex " + std::to_string(vertex + 1);
    fail_input(path, place + ": the coordinates are not finite");
}

void warn(MeshFile& mesh, const std::string& what, std::size_t count) {
    if (count > 0) {
        mesh.warnings.push_back(what + ": " + std::to_string(count));
    }
}

/// Checks every face against the vertices; warns of unused vertices that are not finite.
void check_corners(const Path& path, const PolygonMesh& polygons, MeshFile& mesh) {
    const std::size_t vertex_count = polygons.positions.size() / 3;
    if (vertex_count > std::numeric_limits<std::uint32_t>::max()) {
        fail_input(path, "has more vertices than a face can refer to");
    }
    std::size_t face = 0;
    for (std::size_t i = 0; i < polygons.corners.size(); ++i) {
        while (i >= polygons.face_ends[face]) {
            ++face;
        }
        const std::uint32_t vertex = polygons.corners[i];
        if (vertex >= vertex_count) {
            fail_index(path, polygons, face, vertex);
        }
        if (!is_finite(polygons, vertex)) {
            fail_not_finite(path, polygons, vertex);
        }
    }
    std::size_t not_finite = 0;
    for (std::size_t vertex = 0; vertex < vertex_count; ++vertex) {
        not_finite += is_finite(polygons, vertex) ? 0u : 1u;
    }
    warn(mesh, "unused vertices that are not finite", not_finite);
}

/// Splits all faces. Faces that repeat a vertex keep what is left of them without the repetition.
void split_faces(const PolygonMesh& polygons, MeshFile& mesh) {
    std::size_t too_small = 0;
    std::size_t repeating = 0;
    std::vector<std::uint32_t> corners;
    std::vector<std::uint32_t> parts;
    std::size_t begin = 0;
    for (const std::size_t end : polygons.face_ends) {
        const std::span<const std::uint32_t> face(&polygons.corners[0] + begin, end - begin);
        begin = end;
        if (face.size() < 3) {
            ++too_small;
            continue;
        }
        corners.assign(face.begin(), face.end());
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        while (corners.size() > 1 && corners.front() == corners.back()) {
            corners.pop_back();
        }
        parts.clear();
        triangulate_polygon(mesh.positions, corners, parts);
        const std::size_t size_before = mesh.triangles.size();
        for (std::size_t i = 0; i < parts.size(); i += 3) {
            const std::uint32_t a = parts[i], b = parts[i + 1], c = parts[i + 2];
            if (a != b && b != c && c != a) {
                mesh.triangles.insert(mesh.triangles.end(), {a, b, c});
            }
        }
        repeating += mesh.triangles.size() - size_before < 3 * (face.size() - 2) ? 1u : 0u;
    }
    warn(mesh, "faces with fewer than 3 corners dropped", too_small);
    warn(mesh, "faces with a repeated vertex dropped or simplified", repeating);
}

/// Drops every triangle whose three vertices an earlier triangle has, whichever way round.
void drop_copies(MeshFile& mesh) {
    using Key = std::array<std::uint32_t, 4>; // sorted vertices, then the triangle
    const std::size_t count = mesh.triangles.size() / 3;
    std::vector<Key> keys(count);
    for (std::size_t t = 0; t < count; ++t) {
        const std::uint32_t* corner = &mesh.triangles[3 * t];
        keys[t] = {corner[0], corner[1], corner[2], static_cast<std::uint32_t>(t)};
        std::sort(keys[t].begin(), keys[t].begin() + 3);
    }
    std::sort(keys.begin(), keys.end());
    std::vector<bool> is_copy(count, false);
    std::size_t copies = 0;
    for (std::size_t i = 1; i < count; ++i) {
        if (std::equal(keys[i].begin(), keys[i].begin() + 3, keys[i - 1].begin())) {
            is_copy[keys[i][3]] = true;
            ++copies;
        }
    }
    if (copies == 0) {
        return;
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < count; ++t) {
        if (!is_copy[t]) {
            std::copy_n(&mesh.triangles[3 * t], 3, &mesh.triangles[3 * kept++]);
        }
    }
    mesh.triangles.resize(3 * kept);
    warn(mesh, "duplicate triangles dropped", copies);
}

/// Whether the triangle is more than a line or point, up to rounding, at any scale.
bool has_area(const MeshFile& mesh, const std::uint32_t* corner) {
    Vec3 points[3];
    double largest = 0;
    for (int i = 0; i < 3; ++i) {
        const double* p = &mesh.positions[3 * std::size_t{corner[i]}];
        points[i] = {p[0], p[1], p[2]};
        largest = std::max({largest, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    }
    if (largest == 0) {
        return false;
    }
    const Vec3 a = (1 / largest) * points[0];
    const Vec3 ab = (1 / largest) * points[1] - a;
    const Vec3 ac = (1 / largest) * points[2] - a;
    constexpr double kFlat = 1e-15; // Less height is the rounding of coordinates, which are <= 1.
    return length(cross(ab, ac)) > kFlat * std::max(length(ab), length(ac));
}

MeshFile to_triangles(const Path& path, PolygonMesh&& polygons) {
    MeshFile mesh;
    mesh.warnings = std::move(polygons.warnings);
    if (polygons.face_ends.empty()) {
        fail_input(path, "has no faces");
    }
    check_corners(path, polygons, mesh);
    mesh.positions = std::move(polygons.positions);
    split_faces(polygons, mesh);
    if (mesh.triangles.size() / 3 > std::numeric_limits<std::uint32_t>::max()) {
        fail_input(path, "has too many triangles");
    }
    drop_copies(mesh);
    std::size_t without_area = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        without_area += has_area(mesh, &mesh.triangles[i]) ? 0u : 1u;
    }
    if (3 * without_area == mesh.triangles.size()) {
        fail_input(path, "has no face with an area");
    }
    warn(mesh, "triangles without area kept", without_area);
    return mesh;
}

/// `spec` is NAME or NAME:RESOLUTION.
MeshFile read_builtin(std::string_view spec) {
    const std::size_t colon = std::min(spec.find(':'), spec.size());
    std::optional<int> resolution;
    if (colon < spec.size()) {
        resolution = parse_integer<int>(spec.substr(colon + 1));
        if (!resolution) {
            throw UserError(ExitCode::usage, "builtin:" + std::string(spec) + ": " +
                                                 in_quotes(spec.substr(colon + 1)) +
                                                 " is not a resolution");
        }
    }
    return make_builtin(spec.substr(0, colon), resolution);
}

} // namespace

MeshFile read_mesh(const std::string& path) {
    constexpr std::string_view kBuiltin = "builtin:";
    if (path.starts_with(kBuiltin)) {
        return read_builtin(std::string_view(path).substr(kBuiltin.size()));
    }
    const std::string extension = lower_extension(path);
    if (extension == ".obj") {
        return to_triangles(path, read_obj(path));
    }
    if (extension == ".ply") {
        return to_triangles(path, read_ply(path));
    }
    fail_input(path, "unknown mesh format; known are .obj, .ply and builtin:NAME");
}

} // namespace geodisk::tools
