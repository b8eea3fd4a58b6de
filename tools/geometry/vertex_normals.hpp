// Normals of vertices, from those of their faces.
#pragma once

#include <vector>

#include "geometry/mesh.hpp"
#include "geometry/vec.hpp"

namespace geodisk::tools {

/// Returns the unit vector along `v`, or zero for zero; at any scale.
Vec3 direction(Vec3 v);

/// Returns the sums of the faces' normals at each vertex, each times its angle there. `mesh` must
/// have 3 coordinates.
std::vector<Vec3> normal_sums(const MeshFile& mesh);

} // namespace geodisk::tools
