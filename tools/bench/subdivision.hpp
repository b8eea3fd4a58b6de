// Finer triangles on the same surface.
#pragma once

#include <cstdint>

#include "geometry/mesh.hpp"

namespace geodisk::bench {

/// `mesh` with each edge cut into `parts` equal ones and each triangle into parts^2 similar ones.
/// Neighbours stay neighbours, and the surface stays what it is but for rounding. `parts` is at
/// least 1; the result must not have more than 2^32 - 1 vertices.
tools::MeshFile subdivide(const tools::MeshFile& mesh, std::uint32_t parts);

} // namespace geodisk::bench
