#include "sample_command.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "checkpoint_folder.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "program/failure.hpp"
#include "ranged_sample.hpp"
#include "session.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kMpiSampleExamples[] = {
    "mpirun -n 4 geodisk_mpi sample bunny.obj -o points.ply --count 10000",
    "mpirun -n 4 geodisk_mpi sample bunny.obj -o points.csv --min-distance 1% --json report.json",
    "mpirun -n 4 geodisk_mpi sample bunny.obj -o points.ply -d 0.1% --checkpoint saved --resume",
};

/// Refuses what takes the whole surface at once.
void check_shared(const SampleOptions& options) {
    GivenFields given = given_fields(options, parse_classes(options.classes));
    given.add(RequestField::processes, "geodisk_mpi");
    given.check();
    if (options.out.is_dry_run) {
        fail_usage("--dry-run is not for many processes; use geodisk sample");
    }
}

/// Samples as the first process.
void sample_here(const SampleOptions& options, const CheckpointOptions& checkpoints,
                 std::uint32_t parts, Session& session) {
    std::optional<CheckpointFolder> folder;
    if (!checkpoints.folder.empty()) {
        folder.emplace(checkpoints, options.out.quiet);
        session.save_in(&*folder);
    }
    if (!sample_ranges_to_files(options, parts, session)) {
        sample_to_files(options, {}, &session);
    }
    session.save_in(nullptr);
    if (folder) {
        folder->remove();
    }
}

} // namespace

void add_shared_sample_command(Command app, Session& session) {
    const Command command = app.add_command(
        "sample", "Put samples on a mesh, by all processes, and write them to a file");
    const auto options = std::make_shared<SampleOptions>();
    add_mesh_argument(command, options->mesh, "Mesh to sample");
    add_sample_options(command, *options);
    command.has_footer(help_footer(kMpiSampleExamples));
    const auto checkpoints = std::make_shared<CheckpointOptions>();
    add_checkpoint_options(command, *checkpoints);
    const auto parts = std::make_shared<std::uint32_t>(0);
    command
        .add_option("--parts", *parts, "N",
                    "Parts of each process, of which it holds one mesh at a time, where a mesh is "
                    "read in ranges (default: one for each million faces)",
                    "Many processes")
        .takes_range(1, SharedSurface::kMaxParts);
    command.calls([options, checkpoints, parts, &session] {
        check_shared(*options);
        if (session.is_first()) {
            sample_here(*options, *checkpoints, *parts, session);
        } else {
            const SampleJob job = parse_job(*options);
            session.help(&job);
        }
    });
}

} // namespace geodisk::tools
