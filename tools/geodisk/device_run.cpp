#include "geodisk/device_run.hpp"

#include <algorithm>
#include <optional>

#include <geodisk/count_search.hpp>

#include "files/tuning_file.hpp"
#include "geodisk/opened_device.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/stopwatch.hpp"

namespace geodisk::tools {
namespace {

/// Beyond what most meshes make; disks of so many are told of, since they take long.
constexpr std::uint64_t kManyWindows = 10000;

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

std::uint64_t count_of(const SampleSet& set, const Domain& domain) {
    return domain.dimension() == 0 ? set.samples.size() : set.points.size() / domain.dimension();
}

SampleSet sample(Runner& runner, const Task& task, bool bounded, ProgressLine& progress) {
    auto result = runner.sample_and_wait(task.domain, show_progress(progress, task.expected));
    progress.clear();
    check_interrupted();
    if (!result) {
        check_run(result.error(), bounded);
    }
    return take(std::move(result));
}

} // namespace

void check_run(const Error& error, bool bounded) {
    if (error.status == Status::workspace_too_small ||
        (error.status == Status::out_of_device_memory && bounded)) {
        throw UserError(ExitCode::out_of_memory, error.message + "; give more with --memory");
    }
}

DeviceResult run_on_device(const RunOptions& options, const RunnerOptions& runner_options,
                           const TaskAt& task_at, double min_distance, double wanted,
                           ProgressLine& progress, bool graphics) {
    Task task = task_at(min_distance); // Fails before a device is needed.
    DeviceRun done;
    Stopwatch watch;
    Context context = open_device(options.device, graphics, progress);
    done.open_seconds = watch.seconds();
    done.device = context.report();

    progress.begin_stage("compiling the shaders");
    watch = Stopwatch();
    Runner runner =
        take(Runner::create(context.device(), context.queue(), tuned(runner_options, done.device)));
    take(runner.sampler().prepare(task.domain));
    done.compile_seconds = watch.seconds();
    done.tuning = runner.sampler().tuning();
    check_interrupted();

    SampleSet best;
    decltype(RunReport::seconds) seconds;
    CountSearch search(wanted);
    for (;;) {
        progress.begin_stage(done.runs == 0 ? "sampling" : "sampling at another distance");
        SampleSet set = sample(runner, task, runner_options.device_bytes != 0, progress);
        ++done.runs;
        seconds.compile += set.report.seconds.compile;
        seconds.upload += set.report.seconds.upload;
        seconds.sample += set.report.seconds.sample;
        seconds.readback += set.report.seconds.readback;
        std::optional<double> next;
        if (wanted > 0) {
            next = search.note(min_distance, count_of(set, task.domain));
        }
        if (wanted == 0 || search.is_nearest()) {
            best = std::move(set);
            done.min_distance = min_distance;
        }
        if (!next) {
            break;
        }
        min_distance = *next;
        task = task_at(min_distance);
    }
    check_validation(context);
    done.run = best.report;
    done.run.seconds = seconds;
    return {std::move(best), std::move(done), std::move(context)};
}

} // namespace geodisk::tools
