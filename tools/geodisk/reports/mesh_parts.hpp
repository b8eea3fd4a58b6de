// The parts of a mesh that no path joins.
#pragma once

#include <cstdint>
#include <span>

namespace geodisk::tools {

/// How many parts of a mesh have none of the given triangles, which each take three of `triangles`.
/// Parts are joined by common vertices; a triangle that repeats a vertex belongs to none
/// (MeshStatistics::components).
std::uint64_t parts_without(std::span<const std::uint32_t> triangles,
                            std::span<const std::uint32_t> faces);

} // namespace geodisk::tools
