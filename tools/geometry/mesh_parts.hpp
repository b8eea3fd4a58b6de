// The parts of a mesh that no path joins.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/mesh.hpp>

namespace geodisk::tools {

/// Parts of a mesh that have none of some triangles.
struct BareParts {
    std::uint64_t count = 0;
    double area_share = 0;   ///< Their part of the area that takes samples, 0 to 1.
    std::uint64_t parts = 1; ///< All parts that take samples.
};

/// Finds the parts that have none of `faces`, of those that a mask (SampleParams::face_mask) leaves
/// some faces of.
BareParts parts_without(const PreparedMesh& mesh, std::span<const std::uint32_t> faces,
                        std::span<const std::uint8_t> mask);

/// Returns the number of the part of each triangle, given by three vertices. Parts are joined by
/// common vertices, and numbered by their first triangles; a triangle that repeats a vertex belongs
/// to none (MeshStatistics::components) and has kNoPart.
std::vector<std::uint32_t> part_of_triangles(std::span<const std::uint32_t> triangles);
/// Returns the same of the faces of a mesh.
std::vector<std::uint32_t> part_of_faces(const PreparedMesh& mesh);
inline constexpr std::uint32_t kNoPart = 0xffffffff;

} // namespace geodisk::tools
