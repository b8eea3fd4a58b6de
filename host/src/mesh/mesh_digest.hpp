// Digests of meshes, which come out the same however faces are divided among processes.
#pragma once

#include <cstdint>
#include <span>

#include "geodisk/export.hpp"
#include "geodisk/mesh.hpp"

namespace geodisk {

/// Returns the digest of a face: of its number, its three vertices and its shape.
std::uint64_t face_digest(std::uint64_t face, const std::uint32_t* corners,
                          std::span<const HalfEdge, 3> edges);

/// Returns the digest of a mesh: the sum of those of its faces.
GEODISK_API std::uint64_t mesh_digest(const PreparedMesh& mesh);

} // namespace geodisk
