// Connects the faces of a mesh: all that a face alone does not determine.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geodisk/mesh.hpp"
#include "mesh/connectivity.hpp"

namespace geodisk {

/// Fills in what a face alone does not determine: `around` and `fan_angles` of the half-edges, the
/// fans and the lists of corners. Returns the half-edges on borders.
std::vector<std::uint32_t> connect(const ThreadOptions& threads, IndexView triangles,
                                   std::span<Link> links, std::span<HalfEdge> half_edges,
                                   std::vector<VertexFan>& fans,
                                   std::vector<std::uint32_t>& corners, MeshStatistics& statistics);

} // namespace geodisk
