#include "support/radius_fields.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "lib/rng.hpp"

namespace geodisk::test {

std::vector<double> wavy_factors(const TestMesh& mesh, double least, double waves) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        low = std::min(low, mesh.positions[std::size_t{v} * mesh.dimension]);
        high = std::max(high, mesh.positions[std::size_t{v} * mesh.dimension]);
    }
    std::vector<double> factors;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        const double x = (mesh.positions[std::size_t{v} * mesh.dimension] - low) / (high - low);
        const double height = 0.5 + 0.5 * std::cos(2 * std::numbers::pi * waves * x);
        factors.push_back(least + (1 - least) * height);
    }
    return factors;
}

std::vector<double> rough_factors(const TestMesh& mesh, double least, std::uint32_t seed) {
    std::vector<double> factors;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        factors.push_back(least + (1 - least) * 0x1p-32 * ref::philox(seed, {v, 0, 0, 0})[0]);
    }
    return factors;
}

std::vector<double> density_along(const TestMesh& mesh, const std::function<double(double)>& of_x) {
    std::vector<double> density;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        density.push_back(of_x(mesh.positions[std::size_t{v} * mesh.dimension]));
    }
    return density;
}

std::vector<double> rough_density(const TestMesh& mesh, std::uint32_t seed) {
    std::vector<double> density = rough_factors(mesh, 0, seed);
    for (double& value : density) {
        value = value < 0.25 ? 0 : value * value * value;
    }
    return density;
}

namespace {

RadiusField expect_field(Result<RadiusField> field) {
    if (!field) {
        throw std::runtime_error(field.error().message);
    }
    return std::move(*field);
}

} // namespace

RadiusField density_field(const PreparedMesh& mesh, const std::vector<double>& density) {
    return expect_field(RadiusField::from_density(mesh, density));
}

RadiusField radius_field(const PreparedMesh& mesh, const std::vector<double>& factors) {
    return expect_field(RadiusField::prepare(mesh, factors));
}

FieldCase::FieldCase(TestMesh shape, Make make, const std::vector<double>& values)
    : mesh(std::move(shape)), surface(prepared(mesh)), field(make(surface, values)) {}

SampleParams FieldCase::params(double count, std::uint64_t seed) const {
    SampleParams result;
    result.seed = seed;
    result.radii = &field;
    result.min_distance = distance_for_count(surface, result, count);
    return result;
}

std::string refusal(const Result<RadiusField>& field, std::uint64_t element) {
    if (field) {
        throw std::runtime_error("the field is not refused");
    }
    const Error& error = field.error();
    if (error.status != Status::invalid_argument || error.element != element) {
        throw std::runtime_error("refused otherwise: " + error.message);
    }
    return error.message;
}

} // namespace geodisk::test
