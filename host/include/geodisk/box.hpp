// Boxes of R^n, n = 1 to 6, sampled by straight-line distance (paper section 5.9).
#pragma once

#include <cstdint>
#include <vector>

#include <geodisk/export.hpp>
#include <geodisk/params.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Dimensions of a box.
inline constexpr std::uint32_t kMostBoxDimensions = 6;

/// The guard band of boxes: conflicts are tested against `min_distance * (1 + kBoxGuard)`, which
/// covers what rounding makes of a distance in float.
inline constexpr double kBoxGuard = 0x1p-20;

/// A sampling job in [0, extents[0]) x [0, extents[1]) x ...
struct BoxParams {
    std::vector<double> extents{1, 1}; ///< 1 to 6 sides, each positive.
    /// Opposite sides are glued together: distances go around, and copies of the box side by side
    /// keep the minimum distance. It must not exceed the shortest side then.
    bool is_periodic = false;
    double min_distance = 0; ///< D > 0: no two samples are closer, in the units of the sides.
    std::uint64_t seed = 0;
    double pool_ratio = kDefaultPoolRatio; ///< Candidates per expected sample, 1 to 10,000.
    std::uint32_t throws = 0;              ///< As SampleParams::throws.
    std::uint32_t stop_count = 0;          ///< As SampleParams::stop_count.
};

/// Expected number of samples, by densities measured for each dimension with the default pool
/// ratio and 30 to 30,000 samples (host/docs/boxes.md). An estimate where sides are shorter than a
/// few distances, and a poor one where some are much shorter than one.
GEODISK_API double expected_count(const BoxParams& box) noexcept;

/// The distance that should give about `count` samples, at least 1; `box.min_distance` does not
/// enter. A periodic box with much shorter sides than others may be too thin for it, as pool_size()
/// tells. 0 for a box without sides, or with one that is no positive finite number.
GEODISK_API double distance_for_count(const BoxParams& box, double count) noexcept;

/// Candidates of a job: `throws`, or those that a pool expects, about pool_ratio times the expected
/// count, at least 64. They are as dense in every box, but that boxes with much border have 2, 4,
/// ... times as many, so that a larger box has those of a smaller one with the same lower corner.
///
/// Fails with `invalid_argument` when a parameter is out of range; when a side is more than 2^24
/// distances long, or the pool cannot be indexed with 32 bits; and when the minimum distance
/// exceeds a side of a periodic box.
GEODISK_API Result<std::uint32_t> pool_size(const BoxParams& box) noexcept;

} // namespace geodisk
