// A mesh whose vertices are joined in sets.
#pragma once

#include "geodisk/detail/vertex_sets.hpp"
#include "geodisk/weld.hpp"

namespace geodisk {

/// Makes faces name the lowest vertex of each set.
WeldedMesh with_joined(const MeshView& mesh, VertexSets& sets);

} // namespace geodisk
