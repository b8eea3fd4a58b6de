// Which half-edges share an undirected edge, and which vertices a path can join.
#pragma once

#include <span>

#include "geodisk/mesh.hpp"

namespace geodisk {

/// Fills `HalfEdge::around` from the origins and counts border edges, non-manifold edges and
/// components. Half-edges of a face that names a vertex twice stay alone.
void link_edges(std::span<HalfEdge> half_edges, MeshStatistics& statistics);

/// Whether the face of half-edge h takes part in the surface (names three different vertices).
bool takes_part(std::span<const HalfEdge> half_edges, std::uint32_t h);

} // namespace geodisk
