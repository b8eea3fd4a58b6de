// The sets that runs must return: sequential dart throwing in both precisions.
#pragma once

#include <cstdint>
#include <vector>

#include <geodisk/runner.hpp>

namespace geodisk::test {

/// Ranks that sequential dart throwing accepts, as the float twin decides.
std::vector<std::uint32_t> float_set(const PreparedMesh& mesh, const SampleParams& params,
                                     std::uint32_t chain);
/// The same in double precision.
std::vector<std::uint32_t> double_set(const PreparedMesh& mesh, const SampleParams& params,
                                      std::uint32_t chain);

std::vector<std::uint32_t> ranks_of(const SampleSet& set);

/// Runs on the shared device, by a sampler for the radii of `params`.
SampleSet sample(const PreparedMesh& mesh, const SampleParams& params, RunnerOptions options = {});

/// Parameters for about `count` samples, of these radii.
SampleParams params_for(const PreparedMesh& mesh, double count, std::uint64_t seed = 1,
                        const RadiusField* radii = nullptr);

} // namespace geodisk::test
