// Polygons with any number of coordinates, laid into a plane so that they can be split.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace geodisk::tools {

/// x y 0 of each corner in a plane through the polygon, about 1 wide. A planar polygon keeps its
/// shape up to scale; of another one this is a projection. `positions` holds `dimension`
/// coordinates per vertex; all corners must be finite.
std::vector<double> flattened_polygon(std::span<const double> positions, std::uint32_t dimension,
                                      std::span<const std::uint32_t> corners);

} // namespace geodisk::tools
