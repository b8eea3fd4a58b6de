// Fields of radii for tests: factors g per vertex.
#pragma once

#include <cstdint>
#include <vector>

#include "geodisk/radius_field.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {

/// From `least` to 1, in waves along the first coordinate, `waves` over the mesh.
std::vector<double> wavy_factors(const TestMesh& mesh, double least, double waves = 2);

/// From `least` to 1, for each vertex by itself.
std::vector<double> rough_factors(const TestMesh& mesh, double least, std::uint32_t seed = 1);

/// RadiusField::prepare; throws std::runtime_error with the message when it fails.
RadiusField radius_field(const PreparedMesh& mesh, const std::vector<double>& factors);

} // namespace geodisk::test
