#include "geodisk/device_run.hpp"

#include <algorithm>

#include "common/user_error.hpp"
#include "program/human_text.hpp"
#include "program/tuning_file.hpp"

namespace geodisk::tools {

Context open_device(const std::string& device, bool validate, double& seconds,
                    ProgressLine& progress) {
    ContextOptions options;
    options.device = device;
    options.validation = validate;
    progress.begin_stage("opening the device");
    Context context = timed(seconds, [&] { return take(Context::create(options)); });
    check_interrupted();
    return context;
}

RunnerOptions tuned(RunnerOptions options, const DeviceReport& device) {
    options.sampler.tuning = load_tuning(device).value_or(Tuning());
    return options;
}

ProgressCallback show_progress(ProgressLine& progress, double expected) {
    return [&progress, expected](const Progress& state) {
        // Work is in the disks of accepted candidates, but only the darts are sure to reach the
        // end.
        const double accepted = std::min(0.99, state.accepted / std::max(1.0, expected));
        const double passed = static_cast<double>(state.decided) / state.candidates;
        progress.update(std::max(accepted, passed), grouped(state.accepted) + " samples");
        return !is_interrupted();
    };
}

Runner open_runner(const Context& context, const RunnerOptions& options, const Domain& domain,
                   double& seconds, ProgressLine& progress) {
    progress.begin_stage("compiling the shaders");
    Runner runner = timed(seconds, [&] {
        Runner made = take(
            Runner::create(context.device(), context.queue(), tuned(options, context.report())));
        take(made.sampler().prepare(domain));
        return made;
    });
    check_interrupted();
    return runner;
}

void check_run(const Error& error) {
    if (error.status == Status::workspace_too_small) {
        throw UserError(ExitCode::out_of_memory, error.message + "; give more with --memory");
    }
}

void check_validation(const Context& context) {
    if (context.validation_message_count() > 0) {
        const auto messages = take(context.validation_messages());
        throw UserError(ExitCode::internal,
                        std::to_string(context.validation_message_count()) +
                            " messages of the validation layer, the first: " + messages.front());
    }
}

} // namespace geodisk::tools
