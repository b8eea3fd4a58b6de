#include "geodisk/update_run.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include <geodisk/update.hpp>

#include "files/sample_columns.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/sample_run.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

MeshView view_of(const MeshInput& mesh) {
    return {mesh.file.positions, mesh.file.triangles, mesh.file.dimension};
}

MeshOptions options_of(const SampleJob& job) {
    MeshOptions options = job.mesh;
    options.mesh = job.from;
    return options;
}

} // namespace

UpdateRun::UpdateRun(const SampleJob& job, const MeshInput& mesh, ProgressLine& progress)
    : mesh_(mesh), before_(load_mesh(options_of(job), progress, job.density, job.mask)),
      params_(params_on(before_, job)),
      frame_(frame_for_edits(take(frame_of(before_.prepared, params_)))) {
    if (job.update.empty()) {
        return;
    }
    const HeaderEntries additions = job.additions();
    std::vector<MeshWarning> warnings;
    const SampleFile file =
        read_samples_silently_on(job.update, job.from, before_, &additions, "", warnings, progress);
    if (!file.has_faces) {
        fail_input(job.update, "has no faces and weights, so its samples cannot be updated; give "
                               "a file of geodisk with them");
    }
    if (file.header.find("kept_of") != nullptr) {
        fail_input(job.update, "has just the first samples of --order farthest, so the others are "
                               "not known; give a file with all samples");
    }
    for (const MeshWarning& warning : warnings) {
        print_warning(job.update + ": " + warning.message);
    }
    for (const SampleRow& row : file.rows) {
        samples_.push_back(sample_of(row));
    }
    const auto marks = file.extra_values(kGivenColumn);
    const auto given = static_cast<std::size_t>(std::ranges::count(marks, 1u));
    params_.given = std::span(samples_).first(given);
}

Result<SampleSet> UpdateRun::sample(Runner& runner, const SurfaceTask& surface,
                                    const ProgressCallback&) {
    const SurfaceJob after{view_of(mesh_), surface.params};
    auto updater = Updater::create({view_of(before_), params_}, after, frame_, samples_);
    if (!updater) {
        return updater.error();
    }
    const auto report = updater->update(runner, after.mesh, after.params, {});
    if (!report) {
        return report.error();
    }
    SampleSet set;
    set.samples.assign(updater->samples().begin(), updater->samples().end());
    set.given = updater->given();
    set.report = report->run;
    return set;
}

} // namespace geodisk::tools
