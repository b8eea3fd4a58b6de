// Borders that lie on each other, as where the vertices along a seam are doubled.
#pragma once

#include <cstdint>
#include <span>

#include "geodisk/mesh.hpp"

namespace geodisk {

/// How many of these half-edges, each the only one of its edge, have both ends exactly where those
/// of another one are.
std::uint64_t count_coinciding(const MeshView& mesh, std::span<const HalfEdge> half_edges,
                               std::span<const std::uint32_t> borders);

} // namespace geodisk
