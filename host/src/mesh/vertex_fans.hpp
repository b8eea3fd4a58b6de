// The corners around each vertex in rotational order, with their angles.
#pragma once

#include <span>
#include <vector>

#include "geodisk/mesh.hpp"

namespace geodisk {

/// Fills one fan per vertex, the corner lists and `HalfEdge::angle_start`, and counts used vertices.
/// A corner is named by the half-edge that starts at it.
void build_fans(std::span<HalfEdge> half_edges, std::span<VertexFan> fans,
                std::vector<std::uint32_t>& corners, MeshStatistics& statistics);

} // namespace geodisk
