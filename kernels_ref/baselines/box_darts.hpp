// Sequential dart throwing in boxes of R^n. Results are coordinates, point after point, in the
// order of acceptance.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "baselines/box.hpp"

namespace geodisk::ref {

/// Returns `count` uniform points in the box.
std::vector<double> draw_points(const Box& box, std::uint32_t count, std::uint64_t seed);

/// Throws darts at one to two minimum distances from a random accepted sample, which retires after
/// `trials` failures in a row (Bridson, "Fast Poisson disk sampling in arbitrary dimensions",
/// 2007).
std::vector<double> throw_around_samples(const Box& box, double min_distance, std::uint32_t trials,
                                         std::uint64_t seed);

/// Throws darts until none fits any more (Ebeida, Mitchell, Patney, Davidson and Owens, "A simple
/// algorithm for maximal Poisson-disk sampling in high dimensions", 2012): into cells that no disk
/// covers, which are split into 2^n repeatedly. Each dart is uniform in the uncovered rest.
/// Practical up to four dimensions.
std::vector<double> throw_until_maximal(const Box& box, double min_distance, std::uint64_t seed);

} // namespace geodisk::ref
