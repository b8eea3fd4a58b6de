// The parts of a mesh that no path joins.
#pragma once

#include <cstdint>
#include <span>

#include <geodisk/mesh.hpp>

namespace geodisk::tools {

/// Parts of a mesh that have none of some triangles.
struct BareParts {
    std::uint64_t count = 0;
    double area_share = 0; ///< Their part of the mesh's area, 0 to 1.
};

/// Finds the parts that have none of `faces`. Parts are joined by common vertices; a triangle that
/// repeats a vertex belongs to none (MeshStatistics::components).
BareParts parts_without(const PreparedMesh& mesh, std::span<const std::uint32_t> faces);

} // namespace geodisk::tools
