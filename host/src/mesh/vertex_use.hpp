// Vertices that no face uses; their values are ignored.
#pragma once

#include <cstddef>

#include "geodisk/mesh.hpp"

namespace geodisk {

/// Returns true if a face that takes part uses the vertex.
inline bool is_used(const PreparedMesh& mesh, std::size_t vertex) {
    return mesh.fans()[vertex].corner_count > 0;
}

} // namespace geodisk
