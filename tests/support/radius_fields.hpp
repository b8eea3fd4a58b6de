// Fields of radii for tests: factors g or densities per vertex.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "geodisk/params.hpp"
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

/// A mesh with radii that vary.
struct FieldCase {
    using Make = RadiusField (*)(const PreparedMesh& mesh, const std::vector<double>& values);

    TestMesh mesh;
    PreparedMesh surface;
    RadiusField field;

    FieldCase(TestMesh shape, Make make, const std::vector<double>& values);

    /// Parameters for about `count` samples.
    SampleParams params(double count, std::uint64_t seed = 1) const;
};

/// Message of a field that is refused for its values; throws std::runtime_error where it is not,
/// or not as a wrong argument that names `element`.
std::string refusal(const Result<RadiusField>& field, std::uint64_t element);

} // namespace geodisk::test
