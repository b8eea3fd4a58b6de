#include "geodisk/device_run.hpp"

#include <algorithm>

#include "files/tuning_file.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/stopwatch.hpp"

namespace geodisk::tools {
namespace {

/// Beyond what most meshes make; disks of so many are told of, since they take long.
constexpr std::uint64_t kManyWindows = 10000;

/// As --device and --validate ask.
Context open_device(const RunOptions& options, ProgressLine& progress) {
    progress.begin_stage("opening the device");
    Context context = take(Context::create({options.device, options.validate, {}}));
    check_interrupted();
    return context;
}

/// `options` with the tuning that is kept for the device.
RunnerOptions tuned(RunnerOptions options, const DeviceReport& device) {
    options.sampler.tuning = load_tuning(device).value_or(Tuning());
    return options;
}

/// Draws how far a run is that should give about `expected` samples, and stops it on a signal.
ProgressCallback show_progress(ProgressLine& progress, double expected) {
    return [&progress, expected](const Progress& state) {
        // Work is in the disks of accepted candidates, but only the darts are sure to reach the
        // end.
        const double accepted = std::min(0.99, state.accepted / std::max(1.0, expected));
        const double passed = static_cast<double>(state.decided) / state.candidates;
        std::string text = grouped(state.accepted) + " samples";
        if (const std::uint64_t each = state.windows / std::max(1u, state.disks);
            each >= kManyWindows) {
            text += ", " + grouped(each) + " windows in each disk";
        }
        progress.update(std::max(accepted, passed), text);
        return !is_interrupted();
    };
}

/// Throws UserError for an error of a run that --memory can help with.
void check_run(const Error& error, bool bounded) {
    if (error.status == Status::workspace_too_small ||
        (error.status == Status::out_of_device_memory && bounded)) {
        throw UserError(ExitCode::out_of_memory, error.message + "; give more with --memory");
    }
}

/// Throws UserError if the validation layer had something to say.
void check_validation(const Context& context) {
    if (context.validation_message_count() > 0) {
        const auto messages = take(context.validation_messages());
        throw UserError(ExitCode::internal,
                        std::to_string(context.validation_message_count()) +
                            " messages of the validation layer, the first: " + messages.front());
    }
}

} // namespace

std::pair<SampleSet, DeviceRun> run_on_device(const RunOptions& options,
                                              const RunnerOptions& runner_options,
                                              const Domain& domain, double expected,
                                              ProgressLine& progress) {
    DeviceRun done;
    Stopwatch watch;
    const Context context = open_device(options, progress);
    done.open_seconds = watch.seconds();
    done.device = context.report();

    progress.begin_stage("compiling the shaders");
    watch = Stopwatch();
    Runner runner =
        take(Runner::create(context.device(), context.queue(), tuned(runner_options, done.device)));
    take(runner.sampler().prepare(domain));
    done.compile_seconds = watch.seconds();
    done.tuning = runner.sampler().tuning();
    check_interrupted();

    progress.begin_stage("sampling");
    auto result = runner.sample_and_wait(domain, show_progress(progress, expected));
    progress.clear();
    check_interrupted();
    if (!result) {
        check_run(result.error(), runner_options.device_bytes != 0);
    }
    SampleSet set = take(std::move(result));
    check_validation(context);
    done.run = set.report;
    return {std::move(set), std::move(done)};
}

} // namespace geodisk::tools
