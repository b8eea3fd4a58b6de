// What users should know about a set of samples besides what they asked for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geodisk/sample_run.hpp"
#include "geometry/mesh_warning.hpp"

namespace geodisk::tools {

/// Returns warnings about the samples of a job: a count that was missed, parts of the area without
/// samples, a distance that leaves one sample to each part.
std::vector<MeshWarning> run_warnings(const SampleJob& job, const MeshInput& mesh,
                                      const SampleResult& result);

/// Returns what to say where darts ran out before there were as many samples as asked for; else "".
std::string shortfall(const Method& method, std::uint64_t samples);

/// Prints the warnings.
void print_warnings(const std::vector<MeshWarning>& warnings);

} // namespace geodisk::tools
