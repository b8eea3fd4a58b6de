// Homes of vertices: the process that read a vertex keeps its place for all others.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "parts/ranges/mesh_range.hpp"
#include "parts/ranges/talk.hpp"

namespace geodisk {

/// Returns the coordinates of vertices, in ascending order, from their homes: three each. All
/// processes call it. `own` are the coordinates of this process's block.
std::vector<double> fetch_positions(Talk& talk, const Blocks& blocks, std::span<const double> own,
                                    std::span<const std::uint32_t> vertices);

/// Divides ascending vertices among their homes.
ByProcess<std::uint32_t> by_home(const Blocks& blocks, std::span<const std::uint32_t> vertices);

} // namespace geodisk
