#include "geodisk/box.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/box_grid.hpp"
#include "geodisk/philox.hpp"
#include "support/number_text.hpp"

namespace geodisk {
namespace {

/// How many samples there are, by dimension: density / D^n * (side + 2 * overhang * D)^n, without
/// overhang in a periodic box. Measured by sequential dart throwing with 20 candidates per sample.
struct Density {
    double density;
    double overhang; ///< Border samples keep others away on one side only.
};
constexpr Density kDensities[kMostBoxDimensions] = {{0.726, 0.281}, {0.601, 0.295}, {0.540, 0.280},
                                                    {0.523, 0.262}, {0.545, 0.245}, {0.597, 0.237}};

constexpr double kMinimumPool = 64;
// A distance then still has 256 steps of a coordinate.
constexpr double kLongestSide = 0x1p24;

Error invalid(std::string message) {
    return {Status::invalid_argument, std::move(message)};
}

double shortest_side(const BoxParams& box) {
    return *std::min_element(box.extents.begin(), box.extents.end());
}

Result<Done> check_sides(const BoxParams& box) {
    if (box.extents.empty() || box.extents.size() > kMostBoxDimensions) {
        return invalid("a box must have 1 to 6 sides, not " + std::to_string(box.extents.size()));
    }
    for (std::size_t axis = 0; axis < box.extents.size(); ++axis) {
        if (!(box.extents[axis] > 0) || !std::isfinite(box.extents[axis])) {
            return invalid("side " + std::to_string(axis + 1) +
                           " of the box must be a positive finite number");
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
    const auto [shortest, longest] = std::minmax_element(box.extents.begin(), box.extents.end());
    // The more samples the shorter: halve the exponents in between.
    double low = std::log(*shortest) - 30, high = std::log(*longest) + 3;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (count_at(box, std::exp(middle)) > count ? low : high) = middle;
    }
    return std::exp(high);
}

Result<std::uint32_t> pool_size(const BoxParams& box) noexcept {
    if (!(box.min_distance > 0) || !std::isfinite(box.min_distance)) {
        return invalid("the minimum distance must be a positive finite number");
    }
    if (!(box.pool_ratio >= 1 && box.pool_ratio <= 10000)) {
        return invalid("the pool ratio must be 1 to 10,000");
    }
    if (auto checked = check_sides(box); !checked) {
        return checked.error();
    }
    const double wanted = std::ceil(box.pool_ratio * expected_count(box));
    if (!(wanted <= kMostCandidates)) {
        return invalid("the minimum distance is too small for this box: the pool would take " +
                       number_text(wanted) + " candidates, the most is " +
                       number_text(kMostCandidates));
    }
    return static_cast<std::uint32_t>(std::max(wanted, kMinimumPool));
}

void candidate_point(const BoxParams& box, std::uint32_t candidate,
                     std::span<double> point) noexcept {
    for (std::size_t axis = 0; axis < point.size(); ++axis) {
        const auto block = static_cast<std::uint32_t>(axis / 4);
        const std::uint32_t steps = philox(box.seed, candidate, block)[axis % 4];
        point[axis] = steps * 0x1p-32 * box.extents[axis];
    }
}

} // namespace geodisk
