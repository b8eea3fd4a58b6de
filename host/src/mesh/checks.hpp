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

/// Whether the area of all faces is more than rounding for a mesh of this extent.
bool has_area(double area, double extent);

Result<Done> check_threads(const ThreadOptions& threads);

/// Whether a mesh of so many faces and vertices can be indexed and has any face.
Result<Done> check_counts(std::uint64_t faces, std::uint64_t vertices);

} // namespace geodisk
