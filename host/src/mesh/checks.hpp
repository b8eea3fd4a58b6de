// Checks of a caller's mesh before it is prepared.
#pragma once

#include <span>

#include "geodisk/mesh.hpp"
#include "geodisk/status.hpp"

namespace geodisk {

inline constexpr std::uint32_t kMaxDimensions = 8;

/// Checks sizes, the indices of all faces, and the coordinates of all vertices they use.
Result<Done> check_mesh(const MeshView& mesh);

/// Checks sizes, and the indices and coordinates of these faces alone.
Result<Done> check_faces(const MeshView& mesh, std::span<const std::uint32_t> faces);

/// Checks sizes, indices, lengths, and the triangle inequality.
Result<Done> check_mesh(const LengthMeshView& mesh);

/// Checks that the faces of each edge agree about its length. The half-edges must be linked.
Result<Done> check_agreement(std::span<const HalfEdge> half_edges);

/// Returns true if the area of all faces is more than rounding for a mesh of this extent.
bool has_area(double area, double extent);
/// Refuses a mesh of less area, or of an extent that is too small for areas.
Result<Done> check_area(double area, double extent);

Result<Done> check_threads(const ThreadOptions& threads);

/// Checks that a mesh of this size has faces and can be indexed.
Result<Done> check_counts(std::uint64_t faces, std::uint64_t vertices);

} // namespace geodisk
