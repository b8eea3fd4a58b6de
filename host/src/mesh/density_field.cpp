// Radii and candidates from a density, which may be zero and is linear in each face.
//
// The radius at a point is r_max / sqrt(s). The packing s is also linear in each face. Where s
// equals the density, candidates as dense as s give samples as dense as s. Elsewhere s is larger,
// because radii are limited to r_max and vary by at most kMostInFace within a face. There,
// candidates are thinned to the share that gives the density.
#include "geodisk/radius_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "mesh/candidate_share.hpp"
#include "mesh/vertex_use.hpp"
#include "support/guard.hpp"
#include "support/number_text.hpp"

namespace geodisk {
namespace {

/// Maximum ratio of packings over the surface, so that radii differ by a factor of at most 32; and
/// in a face, because large disks among small ones take long to compute.
constexpr double kMostPacking = 1024;
constexpr float kMostInFace = 16;
/// Smallest density that does not count as zero, in units of the smallest packing. Avoids denormal
/// products.
constexpr double kLeastDensity = 0x1p-40;
/// Number of strips along each side of a face, for the integral over a share from 0 to 1.
constexpr double kStrips = 16;

Result<Done> check_density(const PreparedMesh& mesh, std::span<const double> density) {
    if (density.size() != mesh.vertex_count()) {
        return Error{Status::invalid_argument,
                     "there are " + std::to_string(density.size()) + " densities for " +
                         std::to_string(mesh.vertex_count()) + " vertices"};
    }
    bool any = false;
    for (std::size_t v = 0; v < density.size(); ++v) {
        if (!is_used(mesh, v)) {
            continue;
        }
        if (!(density[v] >= 0) || !std::isfinite(density[v])) {
            return Error{Status::invalid_argument,
                         "the density of vertex " + std::to_string(v) + " (from 0) is " +
                             exact_text(density[v]) + "; it must be 0 or positive, and finite",
                         v};
        }
        any = any || density[v] > 0;
    }
    if (!any) {
        return Error{Status::invalid_argument, "the density is 0 everywhere, so no samples fit"};
    }
    return Done{};
}

/// Returns the densities in units of the smallest packing; zero at unused vertices. Sets that unit.
std::vector<float> scaled_density(const PreparedMesh& mesh, std::span<const double> density,
                                  double& least_density) {
    double most = 0;
    for (std::size_t v = 0; v < density.size(); ++v) {
        most = is_used(mesh, v) ? std::max(most, density[v]) : most;
    }
    double least = 1;
    for (std::size_t v = 0; v < density.size(); ++v) {
        if (is_used(mesh, v) && density[v] > 0) {
            least = std::min(least, density[v] / most);
        }
    }
    const double unit = std::max(least, 1 / kMostPacking);
    least_density = most * unit;
    std::vector<float> scaled(density.size(), 0.0f);
    for (std::size_t v = 0; v < density.size(); ++v) {
        const double value = is_used(mesh, v) ? density[v] / most / unit : 0;
        scaled[v] = value < kLeastDensity ? 0.0f : static_cast<float>(value);
    }
    return scaled;
}

/// Returns the packing at each vertex, in the same unit.
std::vector<float> packing_for(const PreparedMesh& mesh, const std::vector<float>& density) {
    std::vector<float> packing(density.size());
    for (std::size_t v = 0; v < density.size(); ++v) {
        packing[v] = std::max(1.0f, density[v]);
    }
    const auto edges = mesh.half_edges();
    for (std::size_t h = 0; h < edges.size(); h += 3) {
        const float most = std::max(
            {density[edges[h].origin], density[edges[h + 1].origin], density[edges[h + 2].origin]});
        for (std::size_t corner = h; corner < h + 3; ++corner) {
            float& value = packing[edges[corner].origin];
            value = std::max(value, most / kMostInFace);
        }
    }
    return packing;
}

double quotient(double a, double b) {
    return std::min(1.0, a / b);
}

/// Returns the mean density of candidates over a face, in the same unit.
double mean_candidates(const float* density, const float* packing) {
    std::array<double, 3> u{}, s{};
    double least = 1, most = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        u[k] = static_cast<double>(density[k]);
        s[k] = static_cast<double>(packing[k]);
        least = std::min(least, u[k] / s[k]);
        most = std::max(most, u[k] / s[k]);
    }
    if (least == 1) {
        return (s[0] + s[1] + s[2]) / 3;
    }
    const int strips = 1 + static_cast<int>(kStrips * (most - least));
    double sum = 0;
    const auto add = [&](double i, double k) { // Adds the part with its center at this many thirds.
        const double w1 = i / (3 * strips), w2 = k / (3 * strips), w0 = 1 - w1 - w2;
        const double here = w0 * s[0] + w1 * s[1] + w2 * s[2];
        const double share = quotient(w0 * u[0] + w1 * u[1] + w2 * u[2], here);
        sum += here * candidates_for_share(share, quotient);
    };
    for (int i = 0; i < strips; ++i) {
        for (int k = 0; i + k < strips; ++k) {
            add(3 * i + 1, 3 * k + 1);
            if (i + k + 1 < strips) {
                add(3 * i + 2, 3 * k + 2);
            }
        }
    }
    return sum / (double{1.0} * strips * strips);
}

} // namespace

Result<RadiusField> RadiusField::from_density(const PreparedMesh& mesh,
                                              std::span<const double> density) noexcept {
    return guarded([&]() -> Result<RadiusField> {
        if (auto checked = check_density(mesh, density); !checked) {
            return checked.error();
        }
        RadiusField field;
        const std::vector<float> scaled = scaled_density(mesh, density, field.least_density_);
        const std::vector<float> packing = packing_for(mesh, scaled);
        const std::size_t corners = mesh.half_edges().size();
        field.factors_.reserve(corners);
        field.spreads_.reserve(corners);
        field.packing_.reserve(corners);
        for (const HalfEdge& edge : mesh.half_edges()) {
            const float s = packing[edge.origin];
            field.packing_.push_back(s);
            field.factors_.push_back(1.0f / std::sqrt(s));
            field.spreads_.push_back(scaled[edge.origin]);
        }
        field.densities_.reserve(mesh.face_count());
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            const HalfEdge& edge = mesh.half_edges()[std::size_t{3} * f];
            const double area = 0.5 * edge.length * edge.apex_y;
            const float* const u = &field.spreads_[std::size_t{3} * f];
            const double candidates = mean_candidates(u, &field.packing_[std::size_t{3} * f]);
            field.densities_.push_back(static_cast<float>(candidates));
            field.largest_density_ = std::max(field.largest_density_, field.densities_.back());
            field.effective_area_ += area * (double{u[0]} + double{u[1]} + double{u[2]}) / 3;
        }
        if (!(field.effective_area_ > 0)) {
            return Error{Status::invalid_argument,
                         "the density is 0 on all faces that have an area, so no samples fit"};
        }
        return field;
    });
}

double RadiusField::share_at(std::size_t half_edge) const noexcept {
    return packing_.empty() ? 1 : double{spreads_[half_edge]} / double{packing_[half_edge]};
}

double RadiusField::least_factor() const noexcept {
    return static_cast<double>(*std::min_element(factors_.begin(), factors_.end()));
}

} // namespace geodisk
