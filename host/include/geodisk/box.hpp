// Boxes of R^n, n = 1 to 6, sampled by straight-line distance (paper section 5.9).
// Stable.
#pragma once

#include <cstdint>
#include <vector>

#include <geodisk/export.hpp>
#include <geodisk/params.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Maximum of dimensions of a box.
inline constexpr std::uint32_t kMaxBoxDimensions = 6;

/// Guard of boxes: conflicts are tested against `min_distance * (1 + kBoxGuard)`, which covers the
/// rounding of distances in float.
inline constexpr double kBoxGuard = 0x1p-20;

/// A sampling job in [0, extents[0]) x [0, extents[1]) x ...
struct BoxParams {
    std::vector<double> extents{1, 1}; ///< 1 to 6 sides, each positive.
    /// Glues opposite sides together: distances go around, and copies of the box side by side keep
    /// the minimum distance. It must then not exceed the shortest side.
    bool is_periodic = false;
    double min_distance = 0; ///< D > 0: no two samples are closer, in the units of the sides.
    std::uint64_t seed = 0;
    double pool_ratio = kDefaultPoolRatio; ///< Candidates per expected sample, 1 to 10,000.
    std::uint32_t darts = 0;               ///< As SampleParams::darts.
    std::uint32_t stop_count = 0;          ///< As SampleParams::stop_count.
};

/// Returns the expected number of samples, from densities measured for each dimension with the
/// default pool ratio and 30 to 30,000 samples (host/docs/boxes.md). A rough estimate for sides
/// shorter than a few distances, and a poor one for sides much shorter than one.
GEODISK_API double expected_count(const BoxParams& box) noexcept;

/// Returns the distance that should give about `count` samples, at least 1; ignores
/// `box.min_distance`. A periodic box with a very short side may be too thin for the distance, see
/// pool_size(). Returns 0 for a box without sides, or with a side that is not positive and finite.
GEODISK_API double distance_for_count(const BoxParams& box, double count) noexcept;

/// Returns the candidates of a job: `darts`, or about pool_ratio times the expected count, at
/// least
/// 64. Their density is the same in every box, so a larger box has the candidates of a smaller one
/// with the same lower corner; boxes with much border have 2, 4, ... times as many.
///
/// Errors: `invalid_argument` for a parameter out of range, a side longer than 2^24 distances, a
/// pool of more than 2^32 candidates, and a distance longer than a side of a periodic box.
GEODISK_API Result<std::uint32_t> pool_size(const BoxParams& box) noexcept;

} // namespace geodisk
