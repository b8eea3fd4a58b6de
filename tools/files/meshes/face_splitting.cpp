#include "files/meshes/face_splitting.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/polygon_triangulation.hpp"
#include "geometry/shape_warnings.hpp"

namespace geodisk::tools {
namespace {

/// Without corners that equal the one before.
void take_distinct(std::span<const std::uint32_t> face, std::vector<std::uint32_t>& corners) {
    corners.assign(face.begin(), face.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    while (corners.size() > 1 && corners.front() == corners.back()) {
        corners.pop_back();
    }
}

/// Part of its size by which a polygon may differ from a plane. More is another surface along the
/// other diagonal.
constexpr double kBent = 0.1;

bool are_triangles(const PolygonMesh& polygons) {
    for (std::size_t face = 0; face < polygons.face_ends.size(); ++face) {
        if (polygons.face_ends[face] != 3 * (face + 1)) {
            return false;
        }
    }
    return true;
}

} // namespace

std::uint64_t triangles_of(const PolygonMesh& polygons) {
    std::uint64_t count = 0;
    for (std::size_t f = 0; f < polygons.face_ends.size(); ++f) {
        const std::size_t size = polygons.face(f).size();
        count += size < 3 ? 0 : size - 2;
    }
    return count;
}

SplitCounts split_faces(PolygonMesh& polygons, MeshFile& mesh) {
    SplitCounts counts;
    if (are_triangles(polygons)) {
        mesh.triangles = std::move(polygons.corners);
        for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
            if (!mesh.takes_part(t)) {
                counts.repeating_faces.add(t);
            }
        }
        return counts;
    }
    const std::uint64_t total = triangles_of(polygons);
    mesh.triangles.reserve(3 * total);
    mesh.polygons.reserve(total);
    mesh.polygon_count = static_cast<std::uint32_t>(polygons.face_ends.size());
    std::vector<std::uint32_t> corners;
    for (std::uint32_t f = 0; f < mesh.polygon_count; ++f) {
        const std::span<const std::uint32_t> face = polygons.face(f);
        if (face.size() < 3) {
            counts.small_faces.add(f);
            continue;
        }
        const std::size_t begin = mesh.triangle_count();
        const std::size_t end = begin + face.size() - 2;
        take_distinct(face, corners);
        if (corners.size() > 3) {
            ++counts.polygons;
            if (unevenness(polygons.positions, polygons.dimension, corners) > kBent) {
                counts.bent_faces.add(f);
            }
        }
        triangulate_polygon(polygons.positions, corners, mesh.triangles, polygons.dimension);
        mesh.triangles.resize(3 * end, face[0]);
        mesh.polygons.resize(end, f);
        bool is_whole = true;
        for (std::size_t t = begin; t < end; ++t) {
            is_whole = is_whole && mesh.takes_part(t);
        }
        if (!is_whole) {
            counts.repeating_faces.add(f);
        }
    }
    return counts;
}

Found drop_copies(MeshFile& mesh) {
    // Sorted by their lowest vertex first, by counting; few triangles share it then.
    std::size_t vertices = 0;
    for (const std::uint32_t v : mesh.triangles) {
        vertices = std::max(vertices, v + std::size_t{1});
    }
    std::vector<std::uint32_t> ends(vertices, 0);
    const auto lowest = [&](std::size_t t) {
        return *std::min_element(&mesh.triangles[3 * t], &mesh.triangles[3 * t] + 3);
    };
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        ends[lowest(t)] += mesh.takes_part(t) ? 1u : 0u;
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& end : ends) {
        sum += std::exchange(end, sum);
    }
    std::vector<std::uint32_t> order(sum);
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        if (mesh.takes_part(t)) {
            order[ends[lowest(t)]++] = t;
        }
    }

    using Key = std::array<std::uint32_t, 3>; // The two other vertices, then the triangle.
    std::vector<Key> keys;
    Found copies;
    std::uint32_t begin = 0;
    for (std::uint32_t v = 0; v < vertices; ++v) {
        keys.clear();
        for (; begin < ends[v]; ++begin) {
            const std::uint32_t t = order[begin];
            std::array<std::uint32_t, 3> corners;
            std::copy_n(&mesh.triangles[std::size_t{3} * t], 3, corners.begin());
            std::sort(corners.begin(), corners.end());
            keys.push_back({corners[1], corners[2], t});
        }
        std::sort(keys.begin(), keys.end());
        for (std::size_t i = 1; i < keys.size(); ++i) {
            if (keys[i][0] == keys[i - 1][0] && keys[i][1] == keys[i - 1][1]) {
                std::fill_n(&mesh.triangles[std::size_t{3} * keys[i][2]], 3, v);
                copies.add(keys[i][2]);
            }
        }
    }
    return copies;
}

} // namespace geodisk::tools
