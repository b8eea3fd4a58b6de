// What a run is asked to do, and the numbers that follow from it.
#pragma once

#include <cstdint>

#include "geodisk/export.hpp"
#include "geodisk/mesh.hpp"
#include "geodisk/radius_field.hpp"
#include "geodisk/status.hpp"

namespace geodisk {

/// Packing density (paper section 5.2) that dart throwing from a pool of the default ratio reaches
/// on average; used to translate between a count and a distance.
inline constexpr double kExpectedRho = 0.725;
inline constexpr double kDefaultPoolRatio = 20;
/// Candidates of a job: their index has 32 bits.
inline constexpr std::uint32_t kMostCandidates = 0xffffffff;

/// A sampling job. Lengths are in mesh units.
struct SampleParams {
    double min_distance = 0; ///< D > 0: no two samples are closer along the surface.
    std::uint64_t seed = 0;
    double pool_ratio = kDefaultPoolRatio; ///< Candidates per expected sample, 1 to 10,000.
    /// Darts to throw (paper section 4.1): so many candidates instead of a pool by `pool_ratio`, if
    /// not 0.
    std::uint32_t throws = 0;
    /// Stop once so many samples are accepted, if not 0: those are the first of the samples without
    /// it. There are fewer when the candidates are used up before.
    std::uint32_t stop_count = 0;
    /// Radii that vary over the surface: samples p and q are (g(p) + g(q)) * min_distance / 2
    /// apart, so min_distance is that of two with the largest radius. Null: all radii are
    /// min_distance / 2. It must be of the same mesh and outlive the run, and the sampler must be
    /// one for it (`SamplerOptions::adaptive`).
    const RadiusField* radii = nullptr;
};

/// The guard band that makes float decisions safe, in units of the minimum distance.
///
/// Conflicts are tested against `1 + guard`. A window chain of `chain` crossings errs by less than
/// `guard` when each crossing errs by at most 2^-22 of the distances met: the largest is one disk
/// plus the longest edge.
struct Tolerances {
    float limit;  ///< 1 + guard.
    float margin; ///< A window is dropped only when beaten by more than this.
    float slack;  ///< Intervals are widened by this for hits and apexes.
    double guard;
    std::uint32_t chain; ///< Crossings the guard covers.
};

/// The unit in which the device measures: `min_distance`, or where that is beyond every geodesic
/// distance of the mesh, a bound of those. The samples are the same, and coordinates keep their
/// precision. Takes a search over the edges (milliseconds per 100,000 faces) when `min_distance`
/// exceeds the mesh's diagonal, else no time.
GEODISK_API double working_distance(const PreparedMesh& mesh, double min_distance) noexcept;

/// The same for a run: with radii that vary it is always min_distance, since the smaller ones may
/// matter however large that is.
GEODISK_API double working_distance(const PreparedMesh& mesh, const SampleParams& params) noexcept;

/// The area that a run fills: the mesh's, or with radii that vary RadiusField::effective_area().
GEODISK_API double effective_area(const PreparedMesh& mesh, const SampleParams& params) noexcept;

/// Expected number of samples for a distance: rho^2 A / (2 sqrt(3) r^2) with r = D / 2.
GEODISK_API double expected_count(double area, double min_distance) noexcept;

/// The distance that should give about `count` samples.
GEODISK_API double distance_for_count(double area, double count) noexcept;

/// Packing density r * sqrt(2 sqrt(3) N / A) of a result (paper section 5.2).
GEODISK_API double packing_density(double area, double min_distance, double count) noexcept;

/// Candidates of a job: `throws`, or else pool_ratio times the expected count, at least 64.
///
/// Fails with `invalid_argument` when a parameter is out of range or the radii are of a mesh with
/// another number of faces; when the pool cannot be indexed with 32 bits, telling how many
/// candidates it would take; and when an edge is more than 4,000 distances long, where the guard
/// would outgrow its purpose.
GEODISK_API Result<std::uint32_t> pool_size(const PreparedMesh& mesh,
                                            const SampleParams& params) noexcept;

/// Crossings to provide for: a bound guessed from the faces a disk covers, at least 64.
GEODISK_API std::uint32_t provided_chain(const PreparedMesh& mesh, double min_distance) noexcept;

/// Tolerances for window chains of at most `chain` crossings.
GEODISK_API Tolerances tolerances_for(const PreparedMesh& mesh, double min_distance,
                                      std::uint32_t chain) noexcept;

/// The same for a run; where radii vary, with a little more for their rounding.
GEODISK_API Tolerances tolerances_for(const PreparedMesh& mesh, const SampleParams& params,
                                      std::uint32_t chain) noexcept;

} // namespace geodisk
