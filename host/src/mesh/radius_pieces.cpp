#include "mesh/radius_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/density_values.hpp"
#include "mesh/inverse_square.hpp"

namespace geodisk {
namespace {

/// Returns g^(2/3), by Newton's method from above. Uses only + - * /, so the result is the same on
/// every machine.
float spread_of(float g) {
    const double square = static_cast<double>(g) * static_cast<double>(g);
    double x = 1;
    for (double next = x;; x = next) {
        next = (2 * x + square / (x * x)) / 3;
        if (!(next < x)) {
            return static_cast<float>(x);
        }
    }
}

std::vector<float> at_corners(std::span<const std::uint32_t> triangles,
                              const std::vector<float>& values) {
    std::vector<float> corners;
    corners.reserve(values.empty() ? 0 : triangles.size());
    for (std::size_t i = 0; i < triangles.size() && !values.empty(); ++i) {
        corners.push_back(values[triangles[i]]);
    }
    return corners;
}

} // namespace

VertexRadii VertexRadii::of_factors(std::vector<float> factors) {
    VertexRadii radii;
    radii.spreads.reserve(factors.size());
    for (const float g : factors) {
        radii.spreads.push_back(spread_of(g));
    }
    radii.factors = std::move(factors);
    return radii;
}

VertexRadii VertexRadii::of_density(std::vector<float> density, std::vector<float> packing) {
    VertexRadii radii;
    radii.factors.reserve(packing.size());
    for (const float s : packing) {
        radii.factors.push_back(1.0f / std::sqrt(s));
    }
    radii.spreads = std::move(density);
    radii.packing = std::move(packing);
    return radii;
}

RadiusField RadiusPieces::on_faces(std::span<const std::uint32_t> triangles,
                                   const VertexRadii& radii, const Visit& visit) {
    RadiusField field;
    field.factors_ = at_corners(triangles, radii.factors);
    field.spreads_ = at_corners(triangles, radii.spreads);
    field.packing_ = at_corners(triangles, radii.packing);
    field.densities_.reserve(triangles.size() / 3);
    for (std::size_t first = 0; first < triangles.size(); first += 3) {
        FaceMean mean{};
        double candidates = 0;
        if (field.packing_.empty()) {
            const float* const g = &field.factors_[first];
            candidates = mean_inverse_square(g[0], g[1], g[2]);
            mean = {candidates, 1};
        } else {
            const float* const u = &field.spreads_[first];
            candidates = mean_candidates(u, &field.packing_[first]);
            mean = {double{u[0]} + double{u[1]} + double{u[2]}, 3};
        }
        field.densities_.push_back(static_cast<float>(candidates));
        field.largest_density_ = std::max(field.largest_density_, field.densities_.back());
        visit(mean);
    }
    field.find_least_factor();
    return field;
}

RadiusField RadiusPieces::outline(const RadiusTotals& totals) {
    RadiusField field;
    field.effective_area_ = totals.effective_area;
    field.least_density_ = totals.least_density;
    field.largest_density_ = totals.largest_density;
    field.least_factor_ = totals.least_factor;
    return field;
}

RadiusField RadiusPieces::piece(const PreparedMesh& mesh, const VertexRadii& radii,
                                const RadiusField& outline) {
    RadiusField field = RadiusField::on_mesh(mesh, radii);
    field.effective_area_ = 0;
    field.largest_density_ = outline.largest_density_;
    field.least_density_ = outline.least_density_;
    field.add_areas(mesh);
    return field;
}

} // namespace geodisk
