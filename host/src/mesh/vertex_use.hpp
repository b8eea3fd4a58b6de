// Values of vertices: which count, and what they are along seams.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "geodisk/mesh.hpp"
#include "geodisk/weld.hpp"

namespace geodisk {

/// Returns true if a face that takes part uses the vertex. The values of others are ignored.
inline bool is_used(const PreparedMesh& mesh, std::size_t vertex) {
    const auto joined = mesh.joined_vertices();
    return mesh.fans()[joined.empty() ? vertex : joined[vertex]].corner_count > 0;
}

/// Returns the values of all vertices, with the mean for those that the mesh joined.
inline Result<std::vector<double>> values_on(const PreparedMesh& mesh,
                                             std::span<const double> values) {
    return mesh.joined_vertices().empty()
               ? Result(std::vector<double>(values.begin(), values.end()))
               : means_of_joined(mesh.joined_vertices(), values);
}

} // namespace geodisk
