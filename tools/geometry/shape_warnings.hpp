// Warnings about the shape of a mesh: slivers, and coordinates that leave few digits for it.
#pragma once

#include <cstdint>
#include <span>

#include "geometry/mesh.hpp"

namespace geodisk::tools {

/// Distance of a polygon's corners from its mean plane, as a part of its size; 0 for a triangle,
/// and where there are not three coordinates per vertex.
double unevenness(std::span<const double> positions, std::uint32_t dimension,
                  std::span<const std::uint32_t> corners);

/// Adds a warning where more than 1 % of the triangles are slivers. Needs positions.
void warn_of_slivers(MeshFile& mesh);

/// Adds a warning where coordinates are so far from the origin that floats lose the shape. Needs
/// positions.
void warn_of_far_origin(MeshFile& mesh);

} // namespace geodisk::tools
