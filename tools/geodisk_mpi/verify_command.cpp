#include "verify_command.hpp"

#include <memory>

#include "geodisk/commands/help_text.hpp"
#include "geodisk/commands/verify.hpp"
#include "geodisk/options/verify_options.hpp"
#include "program/failure.hpp"
#include "session.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kMpiVerifyExamples[] = {
    "mpirun -n 4 geodisk_mpi verify bunny.obj points.csv",
    "mpirun -n 4 geodisk_mpi verify bunny.obj points.csv --json report.json",
};

} // namespace

void add_shared_verify_command(Command app, Session& session) {
    const Command command = app.add_command(
        "verify", "Check the distances of samples, by all processes (exact, CPU only)");
    const auto options = std::make_shared<VerifyOptions>();
    add_verify_options(command, *options);
    command.has_footer(help_footer(kMpiVerifyExamples));
    command.calls([options, &session] {
        if (options->samples.empty()) {
            fail_usage("SAMPLES is required; check samples in a box with geodisk verify");
        }
        if (!session.is_first()) {
            session.help(nullptr);
            return;
        }
        verify_samples(*options, [&session](const PairSearch& search, ProgressLine& progress) {
            return session.call<note_together>(NoteCall{search, progress});
        });
    });
}

} // namespace geodisk::tools
