#include "engine/domain/tolerances.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/extent.hpp"

namespace geodisk {
namespace {

constexpr double kRounding = 0x1p-22;
constexpr double kMinSlack = 16; // In roundings.
// Factors are floats, and radii are summed in float: each errs by 2^-23 at most.
constexpr double kRadiiRounding = 0x1p-21;
constexpr double kMinChain = 64;
constexpr double kMaxChain = 1u << 16;
constexpr double kMinGuard = 0x1p-13;
// Minimum guard where radii vary: what is added to a small radius matters more.
constexpr double kRadiiLeastGuard = 0x1p-15;

double power_of_two_from(double x, double least) {
    double power = least;
    while (power < x) {
        power *= 2;
    }
    return power;
}

} // namespace

double working_distance(const PreparedMesh& mesh, double min_distance) {
    if (!(min_distance > mesh.statistics().diagonal)) {
        return min_distance;
    }
    // A little more than the bound, so that what is within it conflicts beyond doubt.
    return std::min(min_distance, 1.01 * distance_bound(mesh));
}

double working_distance(const PreparedMesh& mesh, const SampleParams& params) {
    // The smaller ones may matter, however large the largest is.
    return params.radii != nullptr || !params.class_factors.empty()
               ? params.min_distance
               : working_distance(mesh, params.min_distance);
}

ErrorModel::ErrorModel(const JobFrame& frame)
    : longest_(frame.longest_edge), further_(frame.radii_vary ? kRadiiRounding : 0),
      min_guard_(frame.radii_vary ? kRadiiLeastGuard : kMinGuard), per_crossing_(kRounding) {}

void ErrorModel::widen(const ErrorModel& other) noexcept {
    longest_ = std::max(longest_, other.longest_);
    further_ = std::max(further_, other.further_);
    min_guard_ = std::min(min_guard_, other.min_guard_);
    per_crossing_ = std::max(per_crossing_, other.per_crossing_);
}

double ErrorModel::error_of(std::uint32_t chain, bool trims) const noexcept {
    const double base = per_crossing_ * 4 * std::ceil(longest_) + further_;
    const double half = per_crossing_ / 2;
    const double crossing = trims ? half + std::max(half, base / 16) : per_crossing_;
    return base + chain * crossing;
}

double ErrorModel::guard_for(double error_bound) const noexcept {
    return power_of_two_from(error_bound - further_, min_guard_) + further_;
}

Tolerances ErrorModel::tolerances(double error_bound) const noexcept {
    const double guard = guard_for(error_bound);
    return {static_cast<float>(1 + guard), static_cast<float>(error_bound),
            static_cast<float>(kRounding * power_of_two_from(2 + longest_, kMinSlack)), guard,
            error_bound};
}

// A straight path crosses about the square root of the faces of a disk, which are 2 F / N.
std::uint32_t guessed_chain(const PreparedMesh& mesh, double min_distance) {
    const double faces = 2.0 * static_cast<double>(mesh.statistics().triangles) /
                         std::max(1.0, expected_count(mesh.statistics().area, min_distance));
    return static_cast<std::uint32_t>(std::clamp(8 + 4 * std::sqrt(faces), kMinChain, kMaxChain));
}

} // namespace geodisk
