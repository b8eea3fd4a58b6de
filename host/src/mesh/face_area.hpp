// Tests for faces that have area.
#pragma once

#include <cstddef>
#include <cstdint>

#include "geodisk/mesh.hpp"

namespace geodisk {

/// Returns false for a face without area, or that repeats a vertex.
inline bool has_area(const PreparedMesh& mesh, std::uint32_t face) {
    const auto edges = mesh.half_edges().subspan(std::size_t{3} * face, 3);
    const bool repeats = edges[0].origin == edges[1].origin || edges[1].origin == edges[2].origin ||
                         edges[2].origin == edges[0].origin;
    return !repeats && edges[0].length > 0 && edges[0].apex_y > 0;
}

} // namespace geodisk
