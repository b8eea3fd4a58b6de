// The angles of triangles between points.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace geodisk::tools {

/// The angles of triangles, in degrees.
struct TriangleAngles {
    double least = 0, largest = 0;
    double part_inside = 0; ///< Part of the triangles with all angles from 30 to 120 degrees.
};

/// Returns the angles of flat triangles between points of `dimension` coordinates each; all 0 for
/// no triangle.
TriangleAngles triangle_angles(std::span<const double> points, std::uint32_t dimension,
                               std::span<const std::array<std::uint32_t, 3>> triangles);

} // namespace geodisk::tools
