// A job of sampling a mesh, for the commands that do one.
#pragma once

#include <vector>

#include "files/output/output_file.hpp"
#include "geodisk/device_run.hpp"
#include "geodisk/dry_run.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/sample_options.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/reports/sample_report.hpp"

namespace geodisk::tools {

/// The files that the job reads.
std::vector<NamedFile> files_read(const SampleJob& job);

/// Throws UserError(usage) if the format of the output cannot hold the samples.
void check_target(const SampleJob& job, const MeshInput& mesh);

/// The parameters that the job asks for on a mesh, which must outlive them. Without existing
/// samples and points to avoid.
SampleParams params_on(const MeshInput& mesh, const SampleJob& job);

/// The device that the job asks for, which can draw where there is to be a picture.
RunDevice device_for(const SampleJob& job);

/// Returns the warnings of set_warnings() about the samples of a job.
std::vector<MeshWarning> run_warnings(const SampleJob& job, const MeshInput& mesh,
                                      const SampleResult& result, bool lacks_features = false);

/// Samples `mesh`, which must outlive the result, as the job asks for. Throws UserError, DeviceLost
/// among them.
SampleResult sample_mesh(const SampleJob& job, const MeshInput& mesh, RunDevice& device,
                         ProgressLine& progress);

/// Writes the samples into `file`, opened for the job's output.
void write_sample_file(AtomicFile& file, const SampleJob& job, const MeshInput& mesh,
                       const SampleResult& result, const SampleReport& report);

/// The same as a dry run.
DryRun try_sampling(const SampleJob& job, const MeshInput& mesh, RunDevice& device,
                    ProgressLine& progress);

} // namespace geodisk::tools
