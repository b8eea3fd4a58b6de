// Splitting the faces of a mesh file into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace geodisk::tools {

/// Appends the `corners.size() - 2` triangles of a polygon to `triangles` (nothing for fewer than
/// 3 corners). `positions` holds `dimension` coordinates per vertex; all corners must be finite.
///
/// A polygon that its first corner sees whole becomes a fan in order; any other simple polygon is
/// cut ear by ear in its best-fit plane, so the triangles of a planar polygon cover exactly the
/// polygon. One that crosses itself still yields triangles of its own corners. With more than three
/// coordinates it is first laid into a plane through it.
void triangulate_polygon(std::span<const double> positions, std::span<const std::uint32_t> corners,
                         std::vector<std::uint32_t>& triangles, std::uint32_t dimension = 3);

} // namespace geodisk::tools
