// Fields of radii for tests: factors g or densities per vertex.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "geodisk/radius_field.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {

/// From `least` to 1, in waves along the first coordinate, `waves` over the mesh.
std::vector<double> wavy_factors(const TestMesh& mesh, double least, double waves = 2);

/// From `least` to 1, for each vertex by itself.
std::vector<double> rough_factors(const TestMesh& mesh, double least, std::uint32_t seed = 1);

/// Densities by the first coordinate of each vertex.
std::vector<double> density_along(const TestMesh& mesh, const std::function<double(double)>& of_x);

/// Densities of 0 to 1 for each vertex by itself, zero at a fourth of them.
std::vector<double> rough_density(const TestMesh& mesh, std::uint32_t seed = 1);

/// RadiusField::from_density; throws as radius_field().
RadiusField density_field(const PreparedMesh& mesh, const std::vector<double>& density);

/// RadiusField::prepare; throws std::runtime_error with the message when it fails.
RadiusField radius_field(const PreparedMesh& mesh, const std::vector<double>& factors);

} // namespace geodisk::test
