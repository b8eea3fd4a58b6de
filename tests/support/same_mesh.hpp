// Comparison of two prepared meshes, to the bit.
#pragma once

#include "geodisk/mesh.hpp"

namespace geodisk::test {

/// Every field of every array, and the statistics.
bool same_mesh(const PreparedMesh& a, const PreparedMesh& b);

/// Every field of every array.
bool same_surface(const PreparedMesh& a, const PreparedMesh& b);

} // namespace geodisk::test
