// A job of sampling a mesh, for the commands that do one.
#pragma once

#include <vector>

#include "geodisk/dry_run.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/sample_options.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/reports/sample_report.hpp"

namespace geodisk::tools {

/// The files that the job reads.
std::vector<NamedFile> files_read(const SampleJob& job);

/// Samples `mesh`, which must outlive the result, as the job asks for. Throws UserError.
SampleResult sample_mesh(const SampleJob& job, const MeshInput& mesh, ProgressLine& progress);

/// The same as a dry run.
DryRun try_sampling(const SampleJob& job, const MeshInput& mesh, ProgressLine& progress);

} // namespace geodisk::tools
