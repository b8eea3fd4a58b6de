// What a run is asked to do, and the numbers that follow from it.
#pragma once

#include <cstdint>
#include <span>

#include "geodisk/export.hpp"
#include "geodisk/mesh.hpp"
#include "geodisk/radius_field.hpp"
#include "geodisk/status.hpp"

namespace geodisk {

/// Packing density (paper section 5.2) that dart throwing from a pool of the default ratio reaches
/// on average; used to translate between a count and a distance.
inline constexpr double kExpectedRho = 0.725;
/// Samples by which a border adds to a count, for each distance along it.
inline constexpr double kBorderSamples = 0.174;
/// Candidates of a pool per expected sample.
inline constexpr double kDefaultPoolRatio = 20;
/// Candidates of a job.
inline constexpr std::uint32_t kMostCandidates = 0xffffffff;
/// Candidates per expected sample of a stage, see Stages.
inline constexpr double kStageRatio = 5;
/// Stages of a pool.
inline constexpr std::uint32_t kMostPoolStages = 15;
/// Candidates that one face may expect in one stage.
inline constexpr double kMostPerFace = 0x1p24;

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
    /// min_distance / 2. It must be of the same mesh and outlive the run.
    const RadiusField* radii = nullptr;
    /// What the candidates of each face are drawn by, besides the seed: the same triangle with the
    /// same key has the same candidates in every mesh. Empty: the index of the face. Otherwise one
    /// for each face, and no two alike; they must outlive the run.
    std::span<const std::uint32_t> face_keys{};
};

/// The stages in which the candidates of a job come: each is a Poisson process of its own, drawn
/// face by face, and all of a stage come before those of the next (host/docs/determinism.md).
struct Stages {
    double samples = 0;       ///< Expected of the job.
    double ratio = 0;         ///< Candidates of a pool for each.
    std::uint32_t throws = 0; ///< Darts to throw instead, if not 0: stages until there are so many.
    /// Of several surfaces, each of which has stages of its own: the most that one has, and what
    /// their first ones expect together; else 0.
    std::uint32_t most_stages = 0;
    double most_expected = 0;

    /// Of a pool: its ratio over kStageRatio, rounded up, but at most kMostPoolStages.
    GEODISK_API std::uint32_t pool_stages() const noexcept;
    /// Candidates of a stage for each sample. The stages of a pool are alike. Of darts the first
    /// has kStageRatio, or half as often as it takes to have at most 2^23 in all; and each twice as
    /// many as the one before while they are no more than 640, nor 2^23 in all. No stage has fewer
    /// than 64 in all.
    GEODISK_API double per_sample(std::uint32_t stage) const noexcept;

    /// Candidates that a stage expects (of several surfaces, at most), and all of a pool.
    double expected(std::uint32_t stage) const noexcept {
        return most_expected > 0 ? most_expected : per_sample(stage) * samples;
    }
    double pool() const noexcept { return ratio * samples; }
    /// That take part in the job: its darts, or else its pool.
    double candidates() const noexcept { return throws != 0 ? throws : pool(); }
};

/// The area that a run fills: the mesh's, or with radii that vary RadiusField::effective_area().
GEODISK_API double effective_area(const PreparedMesh& mesh, const SampleParams& params) noexcept;

/// Expected number of samples for a distance: rho^2 A / (2 sqrt(3) r^2) with r = D / 2.
GEODISK_API double expected_count(double area, double min_distance) noexcept;

/// The distance that should give about `count` samples where there are no borders.
GEODISK_API double distance_for_count(double area, double count) noexcept;

/// The same on a mesh, with radii that vary or null: samples beside a border keep no distance from
/// what is beyond it, so that more fit, kBorderSamples for each distance along it (by measurement).
GEODISK_API double distance_for_count(const PreparedMesh& mesh, const RadiusField* radii,
                                      double count) noexcept;

/// Packing density r * sqrt(2 sqrt(3) N / A) of a result (paper section 5.2).
GEODISK_API double packing_density(double area, double min_distance, double count) noexcept;

/// Candidates of a job: `throws`, or those that a pool expects, pool_ratio times the expected
/// count, at least 64.
///
/// Fails with `invalid_argument` when a parameter is out of range, or radii or face keys are not as
/// many as the mesh has faces; when the pool cannot be indexed with 32 bits, telling how many
/// candidates it would take; when an edge is more than 4,000 distances long, where the guard would
/// outgrow its purpose; and when a face alone, `Error::element`, expects more than kMostPerFace
/// candidates in a stage.
GEODISK_API Result<std::uint32_t> pool_size(const PreparedMesh& mesh,
                                            const SampleParams& params) noexcept;

} // namespace geodisk
