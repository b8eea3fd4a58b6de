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

RadiusField radius_field(const PreparedMesh& mesh, const std::vector<double>& factors) {
    auto field = RadiusField::prepare(mesh, factors);
    if (!field) {
        throw std::runtime_error(field.error().message);
    }
    return std::move(*field);
}

} // namespace geodisk::test
