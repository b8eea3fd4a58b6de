#include "geodisk/inputs/given_input.hpp"

#include <algorithm>
#include <string>

#include "geodisk/checks/sample_input.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

void check_count(const SampleJob& job, std::size_t given) {
    const double wanted = job.method.stop_count != 0 ? job.method.stop_count : job.wanted_count;
    if (wanted > 0 && static_cast<double>(given) >= wanted) {
        fail_usage("--count: " + counted(given, "sample", "samples") + " of --existing count " +
                   "too, so ask for more than " + grouped(given));
    }
}

} // namespace

GivenInput load_given(const SampleJob& job, const MeshInput& mesh, ProgressLine& progress) {
    GivenInput given;
    const ConstraintOptions& options = job.constraints;
    if (options.existing.empty()) {
        return given;
    }
    const HeaderEntries additions = job.mesh.additions();
    const SampleFile file =
        read_samples_silently_on(options.existing, job.mesh.mesh, mesh, &additions,
                                 options.tolerance, given.warnings, progress);
    if (file.rows.empty()) {
        fail_input(options.existing, "has no samples to keep; leave out --existing");
    }
    check_count(job, file.rows.size());
    for (const SampleRow& row : file.rows) {
        given.samples.push_back({row.face, {row.bary[0], row.bary[1], row.bary[2]}});
    }
    return given;
}

} // namespace geodisk::tools
