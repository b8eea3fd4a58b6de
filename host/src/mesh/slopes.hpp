// Functions on a surface that are linear in each face and change no faster than distances do.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geodisk/mesh.hpp"

namespace geodisk {

/// Raises values at the vertices of a mesh until no face has a gradient of more than 1, and returns
/// them. No path is then shorter than the difference of the values at its ends. Lengths are
/// measured in `unit`.
std::vector<double> raised_to_slope(const PreparedMesh& mesh, double unit,
                                    std::vector<double> values);

/// Raises values likewise, where only some faces may have such a gradient. Appends the vertices
/// that it raises to `raised`, some perhaps more than once.
void raise_to_slope(const PreparedMesh& mesh, double unit, std::span<const std::uint32_t> faces,
                    std::vector<double>& values, std::vector<std::uint32_t>& raised);

} // namespace geodisk
