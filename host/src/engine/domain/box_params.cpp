#include "geodisk/box.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include "engine/domain/box_grid.hpp"
#include "engine/domain/stages.hpp"
#include "geodisk/detail/philox.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Expected number of samples by dimension: density / D^n * (side + 2 * overhang * D)^n, without
/// overhang in a periodic box. Measured by sequential dart throwing with 20 candidates per sample.
struct Density {
    double density;
    double overhang; ///< Border samples have neighbours on one side only.
};
constexpr Density kDensities[kMaxBoxDimensions] = {{0.726, 0.281}, {0.601, 0.295}, {0.540, 0.280},
                                                   {0.523, 0.262}, {0.545, 0.245}, {0.597, 0.237}};

// Fits a float.
constexpr double kLargestIntensity = 0x1p126;
// Square root of 2.
constexpr double kHalfStep = 1.4142135623730951;
// A distance then still has 256 steps of a coordinate.
constexpr double kLongestSide = 0x1p24;

bool is_length(double side) {
    return side > 0 && std::isfinite(side);
}

double shortest_side(const BoxParams& box) {
    return *std::min_element(box.extents.begin(), box.extents.end());
}

Result<Done> check_sides(const BoxParams& box) {
    if (box.extents.empty() || box.extents.size() > kMaxBoxDimensions) {
        return invalid("a box must have 1 to 6 sides, not " + std::to_string(box.extents.size()));
    }
    for (std::size_t axis = 0; axis < box.extents.size(); ++axis) {
        if (!is_length(box.extents[axis])) {
            return invalid("side " + std::to_string(axis + 1) +
                           " of the box must be a positive finite number, not " +
                           exact_text(box.extents[axis]));
        }
        if (!(box.extents[axis] / box.min_distance <= kLongestSide)) {
            return invalid("the minimum distance is too small for this box: side " +
                           std::to_string(axis + 1) + " is " +
                           number_text(box.extents[axis] / box.min_distance) +
                           " times as long, and candidates resolve at most " +
                           number_text(kLongestSide) + " times");
        }
    }
    if (box.is_periodic && box.min_distance > shortest_side(box)) {
        return invalid("the minimum distance, " + number_text(box.min_distance) +
                       ", exceeds the shortest side of the periodic box, " +
                       number_text(shortest_side(box)) +
                       ": a sample would be too close to its own copy");
    }
    return Done{};
}

double count_at(const BoxParams& box, double min_distance) {
    const Density& of = kDensities[std::clamp<std::size_t>(box.extents.size(), 1, 6) - 1];
    double count = of.density;
    for (const double side : box.extents) {
        count *= side / min_distance + (box.is_periodic ? 0 : 2 * of.overhang);
    }
    return std::max(1.0, count);
}

} // namespace

double density_in_box(std::size_t dimension) noexcept {
    return kDensities[dimension - 1].density;
}

double expected_count(const BoxParams& box) noexcept {
    return count_at(box, box.min_distance);
}

double distance_for_count(const BoxParams& box, double count) noexcept {
    if (box.extents.empty() || !std::all_of(box.extents.begin(), box.extents.end(), is_length)) {
        return 0;
    }
    const auto [shortest, longest] = std::minmax_element(box.extents.begin(), box.extents.end());
    // More samples need shorter distances. The bits of positive numbers order like the numbers, so
    // bisection over them finds the same last bit with every mathematical library.
    auto low = std::bit_cast<std::uint64_t>(std::ldexp(*shortest, -44));
    auto high = std::bit_cast<std::uint64_t>(std::ldexp(*longest, 5));
    while (low + 1 < high) {
        const std::uint64_t middle = low + (high - low) / 2;
        (count_at(box, std::bit_cast<double>(middle)) > count ? low : high) = middle;
    }
    return std::bit_cast<double>(high);
}

Result<std::uint32_t> pool_size(const BoxParams& box) noexcept {
    return guarded([&]() -> Result<std::uint32_t> {
        if (!(box.min_distance > 0) || !std::isfinite(box.min_distance)) {
            return invalid("the minimum distance must be a positive finite number, not " +
                           exact_text(box.min_distance));
        }
        if (!(box.pool_ratio >= 1 && box.pool_ratio <= 10000)) {
            return invalid("the pool ratio must be 1 to 10,000, not " + exact_text(box.pool_ratio));
        }
        GEODISK_TRY(check_sides(box));
        const Stages stages = stages_of(box);
        if (!(stages.per_sample(0) * samples_per_volume(box) <= kLargestIntensity)) {
            return invalid(
                "sides of the box are too short beside the minimum distance; leave them out");
        }
        const double wanted = std::ceil(stages.candidates());
        if (!(wanted <= kMaxCandidates)) {
            return invalid("the minimum distance is too small for this box: the pool would take " +
                           number_text(wanted) + " candidates, the maximum is " +
                           number_text(kMaxCandidates));
        }
        return static_cast<std::uint32_t>(wanted);
    });
}

namespace {

/// Returns the volume in units of length; no side counts as shorter than a step.
double volume_of(const BoxParams& box) {
    double volume = 1;
    for (const double extent : box.extents) {
        volume *= std::max(extent / unit_of(box), kShortestSide);
    }
    return volume;
}

} // namespace

double samples_per_volume(const BoxParams& box) noexcept {
    // More candidates for the samples at borders, in steps of two: the box may grow.
    const double density = density_in_box(box.extents.size());
    const double samples = count_at(box, unit_of(box));
    double boost = 1;
    while (boost * kHalfStep < samples / (density * volume_of(box))) {
        boost *= 2;
    }
    return density * boost;
}

Stages stages_of(const BoxParams& box) noexcept {
    const double samples = samples_per_volume(box) * volume_of(box);
    return {samples, pool_ratio_of(box.pool_ratio, samples), box.darts};
}

void sample_point(std::uint64_t job_seed, const DrawAxes& axes, const gpu::SampleRec& sample,
                  std::span<double> point) noexcept {
    const auto number = std::bit_cast<std::uint32_t>(sample.weight1);
    const auto stage = std::bit_cast<std::uint32_t>(sample.weight2);
    const std::size_t n = point.size();
    std::array<std::uint32_t, kMaxBoxDimensions> at{};
    std::uint32_t cell = sample.face;
    for (std::size_t i = 0; i < n; ++i) {
        at[i] = cell % axes[i].cells;
        cell /= axes[i].cells;
    }
    const auto seed_of = [](const std::array<std::uint32_t, 4>& words) {
        return words[0] | std::uint64_t{words[1]} << 32;
    };
    std::uint64_t seed = seed_of(philox(job_seed, {at[0], at[1], at[2], gpu::kCellSeed}));
    if (n > 3) {
        seed = seed_of(philox(seed, {at[3], at[4], at[5], gpu::kCellSeed}));
    }
    const auto first = philox(seed, {number, stage, 0, 0});
    const auto second = philox(seed, {number, stage, 1, 0});
    for (std::size_t i = 0; i < n; ++i) {
        const std::uint32_t word = i < 3 ? first[i + 1] : second[i - 3];
        const DrawAxis& axis = axes[i];
        const std::uint32_t width = at[i] + 1 == axis.cells ? axis.last_width : axis.width;
        const std::uint32_t inside =
            width == 0 ? word : static_cast<std::uint32_t>(std::uint64_t{word} * width >> 32);
        const std::uint64_t steps = std::uint64_t{at[i]} * axis.width + inside;
        point[i] = static_cast<double>(steps) * axis.step;
    }
}

} // namespace geodisk
