// Warnings about the samples of a job, besides what users asked for.
#pragma once

#include <vector>

#include "geodisk/sample_run.hpp"
#include "geometry/mesh_warning.hpp"

namespace geodisk::tools {

/// Returns the warnings of set_warnings() about the samples of a job.
std::vector<MeshWarning> run_warnings(const SampleJob& job, const MeshInput& mesh,
                                      const SampleResult& result, bool lacks_features = false);

/// Prints the warnings.
void print_warnings(const std::vector<MeshWarning>& warnings);

} // namespace geodisk::tools
