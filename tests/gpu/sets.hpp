// The sets that runs must return: sequential dart throwing in both precisions.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include <geodisk/runner.hpp>

#include "device_run.hpp"
#include "engine/domain/listed.hpp"

namespace geodisk::test {

/// Place of a sample.
struct SamplePoint {
    std::uint32_t face;
    float weight1, weight2;
    friend auto operator<=>(const SamplePoint&, const SamplePoint&) = default;
};

/// In dart order.
using Points = std::vector<SamplePoint>;

/// Returns what sequential dart throwing accepts, as the float twin decides; existing samples come
/// first.
Points float_set(const PreparedMesh& mesh, const SampleParams& params, double error_bound);
/// The same with the class of each sample.
Points float_set(const PreparedMesh& mesh, const SampleParams& params, double error_bound,
                 std::vector<std::uint8_t>& classes);
/// Returns what it accepts behind samples that are settled and reject first; they come first.
Points set_after(const PreparedMesh& mesh, const SampleParams& params, double error_bound,
                 const Points& settled);
/// As float_set, in double precision.
Points double_set(const PreparedMesh& mesh, const SampleParams& params, double error_bound);

/// Returns what it accepts of listed candidates behind the existing samples.
Points listed_set(const PreparedMesh& mesh, const SampleParams& params, double error_bound,
                  const Points& candidates);

Points points_of(const SampleSet& set);
Points points_of(const std::vector<ListedCandidate>& candidates);
std::vector<Sample> samples_of(const Points& points);

/// Runs on the shared device, by a sampler for the radii of `params`.
SampleSet sample(const PreparedMesh& mesh, const SampleParams& params, RunnerOptions options = {});

/// Parameters for about `count` samples, of these radii.
SampleParams params_for(const PreparedMesh& mesh, double count, std::uint64_t seed = 1,
                        const RadiusField* radii = nullptr);

/// The samples that a run has put in order so far.
Points ready_points(const DeviceRun& run);

} // namespace geodisk::test
