#include "geodisk/params.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesh/extent.hpp"
#include "support/number_text.hpp"

namespace geodisk {
namespace {

const double kTwoRootThree = 2 * std::sqrt(3.0);
constexpr double kMinimumPool = 64;
// Edges longer than this many distances would need a guard of a percent.
constexpr double kLongestEdge = 4000;
constexpr std::uint32_t kMinimumChain = 64;
constexpr std::uint32_t kMaximumChain = 1u << 16;

/// One disk covers about 2 F / N faces.
double faces_per_disk(const PreparedMesh& mesh, double min_distance) {
    return 2.0 * mesh.face_count() /
           std::max(1.0, expected_count(mesh.statistics().area, min_distance));
}

Tolerances make_tolerances(double longest, std::uint32_t chain, double further) {
    Tolerances t{};
    t.chain = chain;
    t.guard = 0x1p-22 * (chain + 4 * std::ceil(longest)) + further;
    t.limit = static_cast<float>(1 + t.guard);
    t.margin = static_cast<float>(t.guard);
    t.slack = static_cast<float>(0x1p-22 * (2 + longest));
    return t;
}

} // namespace

double working_distance(const PreparedMesh& mesh, double min_distance) noexcept {
    if (!(min_distance > mesh.statistics().diagonal)) {
        return min_distance;
    }
    // A little more than the bound, so that what is within it conflicts beyond doubt.
    return std::min(min_distance, 1.01 * distance_bound(mesh));
}

double working_distance(const PreparedMesh& mesh, const SampleParams& params) noexcept {
    return params.radii != nullptr ? params.min_distance
                                   : working_distance(mesh, params.min_distance);
}

double effective_area(const PreparedMesh& mesh, const SampleParams& params) noexcept {
    return params.radii != nullptr ? params.radii->effective_area() : mesh.statistics().area;
}

double expected_count(double area, double min_distance) noexcept {
    const double radius = min_distance / 2;
    return kExpectedRho * kExpectedRho * area / (kTwoRootThree * radius * radius);
}

double distance_for_count(double area, double count) noexcept {
    return 2 * kExpectedRho * std::sqrt(area / (kTwoRootThree * count));
}

double packing_density(double area, double min_distance, double count) noexcept {
    return min_distance / 2 * std::sqrt(kTwoRootThree * count / area);
}

Result<std::uint32_t> pool_size(const PreparedMesh& mesh, const SampleParams& params) noexcept {
    const auto invalid = [](std::string message) {
        return Error{Status::invalid_argument, std::move(message)};
    };
    if (!(params.min_distance > 0) || !std::isfinite(params.min_distance)) {
        return invalid("the minimum distance must be a positive finite number");
    }
    if (!(params.pool_ratio >= 1 && params.pool_ratio <= 10000)) {
        return invalid("the pool ratio must be 1 to 10,000");
    }
    if (params.radii != nullptr && params.radii->face_count() != mesh.face_count()) {
        return invalid("the radii are of a mesh with " +
                       std::to_string(params.radii->face_count()) + " faces, this one has " +
                       std::to_string(mesh.face_count()));
    }
    const double pool = std::ceil(
        params.pool_ratio * expected_count(effective_area(mesh, params), params.min_distance));
    const double wanted = params.throws != 0 ? params.throws : std::max(pool, kMinimumPool);
    if (!(wanted <= kMostCandidates)) {
        return invalid("the minimum distance is too small for this surface: the pool would take " +
                       number_text(wanted) + " candidates, the most is " +
                       number_text(kMostCandidates));
    }
    const double longest = mesh.statistics().longest_edge / params.min_distance;
    if (!(longest <= kLongestEdge)) {
        return invalid("the minimum distance is too small for this mesh: its longest edge is " +
                       number_text(longest) +
                       " times as long, and single precision resolves at most " +
                       number_text(kLongestEdge) + " times; split long edges");
    }
    return static_cast<std::uint32_t>(wanted);
}

std::uint32_t provided_chain(const PreparedMesh& mesh, double min_distance) noexcept {
    // A straight path crosses about the square root of the faces.
    const double guess = 8 + 4 * std::sqrt(faces_per_disk(mesh, min_distance));
    return static_cast<std::uint32_t>(std::clamp<double>(guess, kMinimumChain, kMaximumChain));
}

Tolerances tolerances_for(const PreparedMesh& mesh, double min_distance,
                          std::uint32_t chain) noexcept {
    const double longest = mesh.statistics().longest_edge / working_distance(mesh, min_distance);
    return make_tolerances(longest, chain, 0);
}

Tolerances tolerances_for(const PreparedMesh& mesh, const SampleParams& params,
                          std::uint32_t chain) noexcept {
    // The factors are floats, and radii are summed in float: each errs by 2^-23 at most.
    constexpr double kRadii = 0x1p-21;
    const double longest = mesh.statistics().longest_edge / working_distance(mesh, params);
    return make_tolerances(longest, chain, params.radii != nullptr ? kRadii : 0);
}

} // namespace geodisk
