// Samples that follow an edit of their mesh: --from and --update of `geodisk sample`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <geodisk/job_frame.hpp>
#include <geodisk/sample.hpp>

#include "geodisk/device_run.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/sample_options.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geometry/mesh_warning.hpp"

namespace geodisk::tools {

/// Names the two meshes of an edit, for errors.
std::string edit_text(const SampleJob& job);

/// The mesh before the edit, and its samples. Samples the edited mesh.
class UpdateRun : public SurfaceSampler {
  public:
    /// Reads the mesh of --from, and the samples of --update if there are any. `mesh` is the edited
    /// mesh; the job and it must outlive this. Throws UserError.
    UpdateRun(const SampleJob& job, const MeshInput& mesh, ProgressLine& progress);

    /// Returns the minimum distance on the mesh before.
    double min_distance() const { return params_.min_distance; }
    const JobFrame& frame() const { return frame_; }
    /// Returns true if there are samples to update.
    bool has_samples() const { return !samples_.empty(); }
    /// Returns the warning that samples of --update do not help, if so.
    const std::optional<MeshWarning>& warning() const { return warning_; }

    Result<SampleSet> sample(Runner& runner, const RequestStep& step,
                             const ProgressCallback& progress) override;
    const std::vector<ProcessReport>& processes() const override { return processes_; }

  private:
    /// Leaves out the samples of --update.
    void decide_all(const std::string& reason);

    const SampleJob& job_;
    const MeshInput& mesh_;
    MeshInput before_;
    SampleParams params_; ///< On the mesh before.
    JobFrame frame_;
    std::vector<Sample> samples_; ///< Before; the existing ones first.
    std::optional<MeshWarning> warning_;
    std::vector<ProcessReport> processes_;
};

} // namespace geodisk::tools
