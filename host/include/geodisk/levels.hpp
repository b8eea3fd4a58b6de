// Levels: samples in progressive order, coarse levels first.
// Experimental.
#pragma once

#include <cstdint>
#include <span>

#include <geodisk/export.hpp>
#include <geodisk/params.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Default of Levels::factor.
inline constexpr double kLevelFactor = 2;
/// Minimum of Levels::factor.
inline constexpr double kMinLevelFactor = 1.1;
/// Maximum of Levels::factor.
inline constexpr double kMaxLevelFactor = 8;
/// Samples that the first level should have at least.
inline constexpr double kFirstLevelSamples = 16;
/// Maximum of Levels::count.
inline constexpr std::uint32_t kMaxLevels = 32;

/// Levels of samples in progressive order. Each level has a smaller distance than the one before,
/// and keeps the samples of all earlier levels: sample params_of_level() level by level. Every
/// level fills what its distance leaves, so the samples up to its end are a Poisson-disk set of
/// that distance.
struct Levels {
    std::uint32_t count = 1;      ///< 1 to kMaxLevels.
    double factor = kLevelFactor; ///< Distance of a level, divided by that of the next.

    /// Returns the distance of a level, divided by that of the last level. Level 0 is the first.
    GEODISK_API double scale(std::uint32_t level) const noexcept;
};

/// Returns levels for a run with these parameters, whose distance is that of the last level. The
/// first level expects kFirstLevelSamples or up to factor^2 times as many.
GEODISK_API Levels levels_for(const PreparedMesh& mesh, const SampleParams& last,
                              double factor = kLevelFactor) noexcept;

/// Returns the parameters of a level. `before` are the samples of all earlier levels; they must
/// outlive the run. Level 0 has the seed and the existing samples of `last`, so it is an ordinary
/// run at its distance. Each later level has a seed of its own, which follows from that of `last`.
/// Not for darts, nor for classes. Errors: `invalid_argument` for a level, count or factor out of
/// range, for darts and for classes.
GEODISK_API Result<SampleParams> params_of_level(const SampleParams& last, const Levels& levels,
                                                 std::uint32_t level,
                                                 std::span<const Sample> before) noexcept;

} // namespace geodisk
