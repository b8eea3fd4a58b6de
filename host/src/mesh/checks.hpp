// What a caller's mesh must satisfy before it is prepared.
#pragma once

#include <span>

#include "geodisk/mesh.hpp"
#include "geodisk/status.hpp"

namespace geodisk {

inline constexpr std::uint32_t kMostDimensions = 8;

/// Sizes, the indices of all faces and the coordinates of all vertices they use.
Result<Done> check_mesh(const MeshView& mesh);

/// Sizes, indices and lengths, and the triangle inequality.
Result<Done> check_mesh(const LengthMeshView& mesh);

/// Whether the faces of each edge agree about its length, once they are linked.
Result<Done> check_agreement(std::span<const HalfEdge> half_edges);

} // namespace geodisk
