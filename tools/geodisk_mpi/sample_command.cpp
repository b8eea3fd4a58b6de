#include "sample_command.hpp"

#include <memory>
#include <string>

#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "program/failure.hpp"
#include "ranged_sample.hpp"
#include "session.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kExamples[] = {
    "mpirun -n 4 geodisk_mpi sample bunny.obj -o points.ply --count 10000",
    "mpirun -n 4 geodisk_mpi sample bunny.obj -o points.csv --min-distance 1% --json report.json",
};

void refuse(const std::string& option) {
    fail_usage(option + " is not for many processes; use geodisk sample");
}

/// What takes the whole surface at once.
void check_shared(const SampleOptions& options) {
    if (!options.classes.empty()) {
        refuse("--classes");
    }
    if (options.method.is_maximal) {
        refuse("--maximal");
    }
    if (options.metric != "geodesic") {
        refuse("--metric " + options.metric);
    }
    if (!options.from.empty()) {
        refuse("--from");
    }
    if (options.out.is_dry_run) {
        refuse("--dry-run");
    }
}

} // namespace

void add_shared_sample_command(Command app, Session& session) {
    const Command command = app.add_command(
        "sample", "Put samples on a mesh, by all processes, and write them to a file");
    const auto options = std::make_shared<SampleOptions>();
    add_mesh_argument(command, options->mesh, "Mesh to sample");
    add_sample_options(command, *options);
    command.has_footer(help_footer(kExamples));
    command.calls([options, &session] {
        check_shared(*options);
        if (session.is_first()) {
            if (!sample_ranges_to_files(*options, session)) {
                sample_to_files(*options, {}, &session);
            }
        } else {
            const SampleJob job = parse_job(*options);
            session.help(&job);
        }
    });
}

} // namespace geodisk::tools
