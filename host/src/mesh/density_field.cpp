// Radii and candidates from a density, which may be zero and is linear in each face.
//
// The radius at a point is r_max / sqrt(s). The packing s is also linear in each face. Where s
// equals the density, candidates as dense as s give samples as dense as s. Elsewhere s is larger,
// because radii are limited to r_max and vary by at most kMaxInFace within a face. There,
// candidates are thinned to the share that gives the density.
#include "geodisk/radius_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "mesh/candidate_share.hpp"
#include "mesh/density_values.hpp"
#include "mesh/radius_pieces.hpp"
#include "mesh/vertex_use.hpp"
#include "support/guard.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Maximum ratio of packings over the surface, so that radii differ by a factor of at most 32; and
/// in a face, because large disks among small ones take long to compute.
constexpr double kMaxPacking = 1024;
constexpr float kMaxInFace = 16;
/// Smallest density that does not count as zero, in units of the smallest packing. Avoids denormal
/// products.
constexpr double kMinDensity = 0x1p-40;
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

/// Returns the unit of a density that check_density() finds no fault with.
DensityUnit unit_of(const PreparedMesh& mesh, std::span<const double> density) {
    double most = 0, least = HUGE_VAL;
    for (std::size_t v = 0; v < density.size(); ++v) {
        if (is_used(mesh, v) && density[v] > 0) {
            most = std::max(most, density[v]);
            least = std::min(least, density[v]);
        }
    }
    return DensityUnit::of(most, least);
}

/// Returns the packing at each vertex, by densities in units of the smallest one.
std::vector<float> packing_for(const PreparedMesh& mesh, const std::vector<float>& density) {
    std::vector<float> packing(density.size());
    std::ranges::transform(density, packing.begin(), packing_of_vertex);
    const auto edges = mesh.half_edges();
    for (std::size_t h = 0; h < edges.size(); h += 3) {
        const float most = std::max(
            {density[edges[h].origin], density[edges[h + 1].origin], density[edges[h + 2].origin]});
        for (std::size_t corner = h; corner < h + 3; ++corner) {
            float& value = packing[edges[corner].origin];
            value = std::max(value, packing_in_face(most));
        }
    }
    return packing;
}

double quotient(double a, double b) {
    return std::min(1.0, a / b);
}

} // namespace

DensityUnit DensityUnit::of(double most, double least) {
    return {most, std::max(std::min(1.0, least / most), 1 / kMaxPacking)};
}

float DensityUnit::scaled(double density) const {
    const double value = density / most / unit;
    return value < kMinDensity ? 0.0f : static_cast<float>(value);
}

float packing_of_vertex(float density) {
    return std::max(1.0f, density);
}

float packing_in_face(float most) {
    return most / kMaxInFace;
}

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

Result<RadiusField> RadiusField::from_density(const PreparedMesh& mesh,
                                              std::span<const double> density) noexcept {
    return guarded([&]() -> Result<RadiusField> {
        GEODISK_TRY(check_density(mesh, density));
        const auto means = values_on(mesh, density);
        GEODISK_TRY(means);
        const DensityUnit unit = unit_of(mesh, *means);
        std::vector<float> scaled(density.size(), 0.0f);
        for (std::size_t v = 0; v < density.size(); ++v) {
            scaled[v] = is_used(mesh, v) ? unit.scaled((*means)[v]) : 0.0f;
        }
        std::vector<float> packing = packing_for(mesh, scaled);
        RadiusField field =
            on_mesh(mesh, VertexRadii::of_density(std::move(scaled), std::move(packing)));
        field.min_density_ = unit.min_density();
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

} // namespace geodisk
