// Colours of a graph: neighbours have different ones.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace geodisk::tools::picture {

/// Returns a colour, counted from 0, for each of `count` nodes, so that the two of each edge
/// differ. Few colours are used: at most six for a planar graph. `edges` are pairs of different
/// nodes. The result depends on nothing else.
std::vector<std::uint32_t> distinct_colors(std::size_t count,
                                           std::span<const std::array<std::uint32_t, 2>> edges);

} // namespace geodisk::tools::picture
