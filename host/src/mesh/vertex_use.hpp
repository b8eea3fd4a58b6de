// Vertices that no face uses: what they have does not matter.
#pragma once

#include <cstddef>

#include "geodisk/mesh.hpp"

namespace geodisk {

/// Whether a face that takes part has the vertex.
inline bool is_used(const PreparedMesh& mesh, std::size_t vertex) {
    return mesh.fans()[vertex].corner_count > 0;
}

} // namespace geodisk
