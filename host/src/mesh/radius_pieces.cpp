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

template <class VertexOf>
RadiusField RadiusPieces::at_corners(std::size_t corners, const VertexOf& vertex_of,
                                     const VertexRadii& radii) {
    RadiusField field;
    const auto fill = [&](std::vector<float>& at, const std::vector<float>& values) {
        at.reserve(values.empty() ? 0 : corners);
        for (std::size_t i = 0; i < corners && !values.empty(); ++i) {
            at.push_back(values[vertex_of(i)]);
        }
    };
    fill(field.factors_, radii.factors);
    fill(field.spreads_, radii.spreads);
    fill(field.packing_, radii.packing);
    field.find_min_factor();
    return field;
}

void RadiusPieces::add_faces(RadiusField& field, const Visit& visit) {
    const std::size_t corners = field.factors_.size();
    field.densities_.reserve(corners / 3);
    for (std::size_t first = 0; first < corners; first += 3) {
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
}

RadiusField RadiusPieces::on_faces(std::span<const std::uint32_t> triangles,
                                   const VertexRadii& radii, const Visit& visit) {
    RadiusField field = factors_on(triangles, radii);
    add_faces(field, visit);
    return field;
}

RadiusField RadiusPieces::on_faces(std::span<const HalfEdge> edges, const VertexRadii& radii,
                                   const Visit& visit) {
    RadiusField field = at_corners(
        edges.size(), [&](std::size_t h) { return edges[h].origin; }, radii);
    add_faces(field, visit);
    return field;
}

RadiusField RadiusPieces::factors_on(std::span<const std::uint32_t> triangles,
                                     const VertexRadii& radii) {
    return at_corners(
        triangles.size(), [&](std::size_t i) { return triangles[i]; }, radii);
}

RadiusField RadiusPieces::outline(const RadiusTotals& totals) {
    RadiusField field;
    field.effective_area_ = totals.effective_area;
    field.min_density_ = totals.min_density;
    field.largest_density_ = totals.largest_density;
    field.min_factor_ = totals.min_factor;
    return field;
}

RadiusField RadiusPieces::piece(const PreparedMesh& mesh, const VertexRadii& radii,
                                const RadiusField& outline) {
    double area = 0;
    std::size_t face = 0;
    RadiusField field = on_faces(mesh.half_edges(), radii, [&](FaceMean mean) {
        const HalfEdge& edge = mesh.half_edges()[3 * face++];
        area += 0.5 * edge.length * edge.apex_y * mean.samples();
    });
    field.effective_area_ = area;
    field.largest_density_ = outline.largest_density_;
    field.min_density_ = outline.min_density_;
    return field;
}

} // namespace geodisk
