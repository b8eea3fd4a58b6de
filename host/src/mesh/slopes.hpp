// Functions on a surface that are linear in each face and change no faster than distances do.
#pragma once

#include <vector>

#include "geodisk/mesh.hpp"

namespace geodisk {

/// Raises values at the vertices of a mesh until no face has a gradient of more than 1, and returns
/// them. No path is then shorter than the difference of the values at its ends. Lengths are
/// measured in `unit`.
std::vector<double> raised_to_slope(const PreparedMesh& mesh, double unit,
                                    std::vector<double> values);

} // namespace geodisk
