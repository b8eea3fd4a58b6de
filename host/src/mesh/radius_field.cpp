#include "geodisk/radius_field.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "mesh/inverse_square.hpp"
#include "mesh/radius_pieces.hpp"
#include "mesh/vertex_use.hpp"
#include "support/guard.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

Result<Done> check_factors(const PreparedMesh& mesh, std::span<const double> factors) {
    if (factors.size() != mesh.vertex_count()) {
        return Error{Status::invalid_argument,
                     "there are " + std::to_string(factors.size()) + " radius factors g for " +
                         std::to_string(mesh.vertex_count()) + " vertices"};
    }
    bool all_zero = true;
    for (std::size_t v = 0; v < factors.size() && all_zero; ++v) {
        all_zero = !is_used(mesh, v) || factors[v] == 0;
    }
    if (all_zero) {
        return Error{Status::invalid_argument, "all radius factors g are zero"};
    }
    for (std::size_t v = 0; v < factors.size(); ++v) {
        if (is_used(mesh, v) && !(factors[v] >= RadiusField::kMinFactor && factors[v] <= 1)) {
            return Error{Status::invalid_argument,
                         "the radius factor g of vertex " + std::to_string(v) + " (from 0) is " +
                             exact_text(factors[v]) + "; it must be from " +
                             exact_text(RadiusField::kMinFactor) + " to 1",
                         v};
        }
    }
    return Done{};
}

} // namespace

Result<RadiusField> RadiusField::prepare(const PreparedMesh& mesh,
                                         std::span<const double> factors) noexcept {
    return guarded([&]() -> Result<RadiusField> {
        GEODISK_TRY(check_factors(mesh, factors));
        const auto means = values_on(mesh, factors);
        GEODISK_TRY(means);
        // Ignored faces may name vertices that no other face uses.
        std::vector<float> values(factors.size(), 1.0f);
        for (std::size_t v = 0; v < factors.size(); ++v) {
            values[v] = is_used(mesh, v) ? static_cast<float>((*means)[v]) : 1.0f;
        }
        return on_mesh(mesh, VertexRadii::of_factors(std::move(values)));
    });
}

RadiusField RadiusField::on_mesh(const PreparedMesh& mesh, const VertexRadii& radii) {
    double area = 0;
    std::size_t face = 0;
    RadiusField field = RadiusPieces::on_faces(mesh.half_edges(), radii, [&](FaceMean mean) {
        const HalfEdge& edge = mesh.half_edges()[3 * face++];
        area += mean.over(0.5 * edge.length * edge.apex_y);
    });
    field.effective_area_ = area;
    return field;
}

void RadiusField::find_min_factor() {
    min_factor_ = 1;
    for (const float g : factors_) {
        min_factor_ = std::min(min_factor_, g);
    }
}

double RadiusField::samples_in(std::uint32_t face) const noexcept {
    const bool by_density = !packing_.empty();
    const float* const at = &(by_density ? spreads_ : factors_)[std::size_t{3} * face];
    return by_density ? (double{at[0]} + double{at[1]} + double{at[2]}) / 3
                      : mean_inverse_square(at[0], at[1], at[2]);
}

double RadiusField::factor_at(std::uint32_t face, const float (&weights)[3]) const noexcept {
    const bool by_density = !packing_.empty();
    const float* const g = &(by_density ? packing_ : factors_)[std::size_t{3} * face];
    const double sum = static_cast<double>(weights[0]) * static_cast<double>(g[0]) +
                       static_cast<double>(weights[1]) * static_cast<double>(g[1]) +
                       static_cast<double>(weights[2]) * static_cast<double>(g[2]);
    return by_density ? 1 / std::sqrt(sum) : sum;
}

} // namespace geodisk
