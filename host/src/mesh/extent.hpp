// How far apart two points of a mesh can be along the surface.
#pragma once

#include "geodisk/mesh.hpp"

namespace geodisk {

/// A bound of every finite geodesic distance: no two points of one component are farther apart.
/// Linear in the mesh; a few times too large. Throws std::bad_alloc.
double distance_bound(const PreparedMesh& mesh);

} // namespace geodisk
