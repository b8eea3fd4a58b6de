#include <memory>

#include "geodisk/commands/commands.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/sample_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/sample_report.hpp"
#include "geodisk/sample_run.hpp"
#include "program/command.hpp"

namespace geodisk::tools {
namespace {

void run_sample(const SampleOptions& options) {
    const SampleJob job = parse_job(options);
    check_outputs(job.out, "the samples", files_read(job)); // Before work that would be in vain.
    ProgressLine progress(job.out.quiet);
    const MeshInput mesh = load_mesh(job.mesh, progress, job.density);
    check_dimension(job.out.output, mesh.dimension());
    const SampleResult result = sample_mesh(job, mesh, progress);
    const SampleReport report(job, mesh, result);
    write_outputs(job.out, "the samples", progress, report, [&](AtomicFile& file) {
        write_samples(file, job.out.output, report.header(), result.rows, job.out.ascii,
                      mesh.dimension());
    });
}

} // namespace

void add_sample_command(Command app) {
    const Command command =
        app.add_command("sample", "Put samples on a mesh and write them to a file");
    const auto options = std::make_shared<SampleOptions>();
    add_sample_options(command, *options);
    command.calls([options] { run_sample(*options); });
}

} // namespace geodisk::tools
