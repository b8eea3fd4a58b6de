// Farthest-point order: samples such that the first ones cover the surface as well as any so few
// do.
// Experimental.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/export.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/sample.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Which samples to put in farthest-point order, and from where.
struct FarthestParams {
    std::uint32_t count = 0; ///< Number of samples to choose; 0 for all.
    std::uint32_t start = 0; ///< Index of the first one. Not with `existing`.
    /// Number of samples that come first as they are: the first of all. The next one is the one
    /// farthest from all of these. They count towards `count`.
    std::uint32_t existing = 0;
};

/// Samples in farthest-point order.
struct FarthestOrder {
    /// Index of each sample, in farthest-point order.
    std::vector<std::uint32_t> indices;
    /// Geodesic distance from each sample to the nearest earlier one, in mesh units. Never
    /// increases. Infinite for existing samples, and for the first one on each connected component
    /// that has none of these.
    std::vector<float> distances;
    /// Largest distance of a sample left out to the nearest one chosen; 0 if none is left out.
    float cover = 0;
    /// Bound on the error of the distances, in mesh units.
    double error = 0;
    std::uint32_t searches = 0; ///< Searches on the device, each of many disks.
    RunReport report;
};

/// Puts samples in farthest-point order: the first sample, or existing ones, then always the one
/// whose geodesic distance to all before it is largest. Ties go to the lower index.
///
/// So all samples are within `distances[k]` of the first k, and these, but for existing ones, are
/// at least `distances[k - 1]` apart. The result is the same on every device and for any memory
/// size. Computes one disk per sample; the first ones cover the whole surface. Progress counts
/// samples as candidates; returns `cancelled` if it asks to stop.
///
/// Errors: `invalid_argument` for no sample; for a `count`, a `start` or a number of
/// existing samples that there is not; for a `start` beside existing samples; for a sample, naming
/// it, in a face that does not exist or repeats a vertex or with weights that are negative or do
/// not sum to 1. Those of check_farthest_order(). Others as Runner::sample_and_wait().
GEODISK_API Result<FarthestOrder> farthest_order(Runner& runner, const PreparedMesh& mesh,
                                                 std::span<const Sample> samples,
                                                 const FarthestParams& params = {},
                                                 const ProgressCallback& progress = {}) noexcept;

/// Checks, before there are samples, that the device holds the mesh: the first disks cover all of
/// it. Errors: `job_too_large` if not.
GEODISK_API Result<Done> check_farthest_order(Runner& runner, const PreparedMesh& mesh) noexcept;

} // namespace geodisk
