// Numbers of vertices, of corners or of faces as numbers at vertices.
#pragma once

#include <vector>

#include "geometry/mesh.hpp"

namespace geodisk::tools {

/// Returns a number for each vertex of the file, those joined alike: the mean over the values that
/// its corners have; of faces, weighted by their areas, so that the sum over the surface stays. 1
/// for vertices without. `number` has one component.
std::vector<double> vertex_numbers(const MeshFile& mesh, const MeshField& number);

} // namespace geodisk::tools
