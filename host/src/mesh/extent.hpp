// Upper bound of geodesic distances on a mesh.
#pragma once

#include "geodisk/mesh.hpp"

namespace geodisk {

/// Returns an upper bound of all finite geodesic distances, a few times too large. Takes time
/// linear in the mesh. Throws std::bad_alloc.
double distance_bound(const PreparedMesh& mesh);

} // namespace geodisk
