#include "geodisk/device_run.hpp"

#include <algorithm>
#include <memory>
#include <system_error>
#include <utility>

#include "files/tuning_file.hpp"
#include "geodisk/opened_device.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/stopwatch.hpp"
#include "program/time_estimate.hpp"

namespace geodisk::tools {
namespace {

/// Beyond what most meshes make; disks of so many are told of, since they take long.
constexpr std::uint64_t kManyWindows = 10000;

/// Fewer disks say little of how long the others take.
constexpr double kFewDisks = 4;

/// Less of a run or search says little of how long the rest takes.
constexpr double kEarly = 0.02;

/// Draws how far a run is that should give about `expected` samples, after the disks of `avoided`
/// points, which say nothing of how long others take. Says once if it takes long, and stops it on a
/// signal.
ProgressCallback show_progress(ProgressLine& progress, DeviceLog& log, double expected,
                               std::size_t avoided) {
    return [&progress, &log, expected, avoided, watch = Stopwatch(), is_first = true,
            time = TimeEstimate(std::clamp(kFewDisks / std::max(1.0, expected), kEarly, 0.05))](
               const Progress& state) mutable {
        log.tell_progress(state);
        const double part = state.disks < avoided ? 0 : part_done(state, expected);
        const std::uint64_t windows = state.windows / std::max(1u, state.disks);
        // The first submission is short. If its disks are small, the driver has compiled kernels.
        if (std::exchange(is_first, false) && state.disks > 0 && windows < kManyWindows) {
            time.wait(watch.seconds());
        }
        time.note(watch.seconds(), part);
        if (const auto seconds = time.long_run()) {
            progress.clear();
            print_warning("sampling takes about " + seconds_text(*seconds) + " on this device");
        } else if (time.is_long_already()) {
            progress.clear();
            print_warning("sampling takes more than " + seconds_text(time.seconds()) +
                          " on this device: disks cover very many triangles");
        }
        std::string text = grouped(state.accepted) + " samples" + time.left_text();
        if (windows >= kManyWindows) {
            text += ", " + grouped(windows) + " windows in each disk";
        }
        progress.update(part, text);
        return !is_interrupted();
    };
}

/// Draws how far a part of a surface is. Nobody knows how far all parts are, so nothing is said of
/// how long they take. Stops it on a signal.
ProgressCallback show_part(ProgressLine& progress, DeviceLog& log) {
    return [&progress, &log](const Progress& state) {
        log.tell_progress(state);
        progress.update(static_cast<double>(state.decided) / state.candidates,
                        grouped(state.accepted) + " samples of this part");
        return !is_interrupted();
    };
}

/// Tells what comes next.
std::string stage_of(const RequestStep& step) {
    return step.is_on_features ? "sampling features"
           : step.level > 0    ? "sampling level " + std::to_string(step.level)
           : step.attempt > 0  ? "sampling at another distance"
                               : "sampling";
}

/// Throws UserError for an error of a request, which names its fields as options.
void check_taken(const Result<Done>& taken) {
    if (taken) {
        return;
    }
    Error error = taken.error();
    if (error.message.starts_with("count: ")) {
        fail_usage("--" + error.message);
    }
    take(Result<Done>(std::move(error)));
}

/// Compiles on all cores what jobs on the device share.
std::shared_ptr<OpenDevice> make_device(Context context, RunnerOptions options) {
    options.sampler.tuning = load_tuning(context.report()).value_or(Tuning());
    options.sampler.threads = ThreadOptions();
    auto sampler =
        std::make_shared<const Sampler>(take(Sampler::create(context.device(), options.sampler)));
    return std::make_shared<OpenDevice>(std::move(context), options, std::move(sampler));
}

} // namespace

ProgressCallback search_progress(ProgressLine& progress, const std::string& found) {
    return [&progress, found, watch = Stopwatch(),
            time = TimeEstimate(kEarly)](const Progress& state) mutable {
        const double part = static_cast<double>(state.decided) / state.candidates;
        time.note(watch.seconds(), part);
        if (const auto seconds = time.long_run()) {
            progress.clear();
            print_warning("searching takes about " + seconds_text(*seconds) + " on this device");
        }
        progress.update(part, grouped(state.accepted) + ' ' + found + time.left_text());
        return !is_interrupted();
    };
}

double part_done(const Progress& state, double expected) {
    // Work is in the disks of accepted candidates, but only the darts are sure to reach the end.
    // Those being worked on may count as decided, all of them at once where disks are few and
    // large.
    const double all = std::max(1.0, expected);
    const double accepted = std::min(0.99, state.accepted / all);
    const double passed = static_cast<double>(state.decided) / state.candidates;
    return std::max(accepted, std::min(passed, (state.disks + 1) / all));
}

void check_run(const Error& error, bool bounded) {
    const bool is_disk = error.status == Status::workspace_too_small;
    if (bounded && (is_disk || error.status == Status::out_of_device_memory)) {
        throw UserError(ExitCode::out_of_memory, error.message + "; give more with --memory");
    }
    if (is_disk) {
        throw UserError(
            ExitCode::out_of_memory,
            error.message +
                "; the device has no more memory. Lower the distance, raise --count, or coarsen "
                "the mesh where its triangles are much smaller than the distance");
    }
    if (error.status == Status::device_lost) {
        throw DeviceLost(error.message);
    }
}

RunDevice::RunDevice(DeviceOptions device, const RunnerOptions& runner, bool graphics,
                     std::shared_ptr<SharedDevice> shared)
    : device_(std::move(device)), options_(runner), graphics_(graphics), log_(device_.verbose),
      shared_(std::move(shared)) {
    options_.time_stages = log_.is_enabled();
}

void RunDevice::open(ProgressLine& progress) {
    if (opened_ && !opened_->device->is_lost) {
        return;
    }
    opened_.reset();
    const std::scoped_lock lock(shared_->mutex);
    std::shared_ptr<OpenDevice>& device = shared_->open;
    if (device == nullptr || device->is_lost) {
        device.reset();
        device = open_shared(progress);
    }
    Runner runner = take(Runner::create(device->sampler, device->context.queue(), device->options));
    opened_.emplace(Opened{device, std::move(runner)});
}

std::shared_ptr<OpenDevice> RunDevice::open_shared(ProgressLine& progress) {
    Begun begun = finish_open(progress);
    open_seconds_ = begun.open_seconds;
    compile_seconds_ = begun.compile_seconds;
    progress.clear();
    const OpenDevice& device = *begun.device;
    log_.tell_device(device.context.report(), device.sampler->tuning(), open_seconds_,
                     compile_seconds_);
    return std::move(begun).device;
}

RunDevice::Begun RunDevice::finish_open(ProgressLine& progress) {
    const Stopwatch watch;
    if (begun_.valid()) {
        progress.begin_stage("opening the device");
        Begun begun = begun_.get();
        progress.clear();
        warn_of_unasked_cpu(device_, begun.device->context);
        check_interrupted();
        // Counts only the time that this thread has waited.
        const double waited = watch.seconds();
        begun.compile_seconds = std::min(begun.compile_seconds, waited);
        begun.open_seconds = std::min(begun.open_seconds, waited - begun.compile_seconds);
        return begun;
    }
    Context context = open_device(device_, graphics_, progress);
    const double open_seconds = watch.seconds();
    progress.begin_stage("compiling the shaders");
    auto device = make_device(std::move(context), options_);
    return {std::move(device), open_seconds, watch.seconds() - open_seconds};
}

void RunDevice::begin_open(Ahead ahead) {
    RunnerOptions options = options_;
    options.sampler.ahead = ahead;
    try {
        begun_ = std::async(std::launch::async, [device = device_, options, draws = graphics_] {
            const Stopwatch watch;
            Context context = create_context(device, draws);
            const double open_seconds = watch.seconds();
            auto open = make_device(std::move(context), options);
            return Begun{std::move(open), open_seconds, watch.seconds() - open_seconds};
        });
    } catch (const std::system_error&) {
        // No thread could be started; open() does it all.
    }
}

double RunDevice::compile(const Domain& domain, ProgressLine& progress) {
    open(progress);
    progress.begin_stage("compiling the shaders");
    const Stopwatch watch;
    take(opened_->runner.sampler().prepare(domain));
    return std::exchange(compile_seconds_, 0) + watch.seconds();
}

SampleSet RunDevice::sample(const RequestStep& step, ProgressLine& progress) {
    progress.begin_stage(stage_of(step));
    log_.tell_task(step.params.min_distance, step.expected);
    const std::size_t avoided = step.params.avoid.size();
    const bool is_divided = sampler_ != nullptr && step.surface != nullptr;
    const ProgressCallback shown = is_divided
                                       ? show_part(progress, log_)
                                       : show_progress(progress, log_, step.expected, avoided);
    auto result = is_divided ? sampler_->sample(opened_->runner, step, shown)
                             : opened_->runner.sample_and_wait(step.domain, shown);
    progress.clear();
    check_interrupted();
    if (!result) {
        Error error = result.error();
        if (avoided > 0 && error.status == Status::workspace_too_small) {
            error.message +=
                "; disks of --avoid far larger than the distance take most of it: lower "
                "their radii, or leave out faces within them by --mask";
        }
        check(error);
    }
    SampleSet set = take(std::move(result)); // Throws for an error; only a set has a report.
    log_.tell_run(set.report);
    return set;
}

DeviceResult RunDevice::run(RequestRun request, ProgressLine& progress) {
    DeviceRun done;
    while (const RequestStep* step = request.step()) {
        if (step->attempt == 0 && step->level == 0) { // Others need the same kernels.
            done.compile_seconds += compile(step->domain, progress);
            check_interrupted();
        }
        check_taken(request.take(sample(*step, progress)));
    }
    check_validation(context());
    RequestedSet found = std::move(request).finish();
    done.open_seconds = std::exchange(open_seconds_, 0);
    done.device = context().report();
    done.tuning = opened_->runner.sampler().tuning();
    done.min_distance = found.min_distance;
    done.runs = found.tries;
    done.cut = found.cut;
    done.run = found.set.report;
    done.ends = found.ends;
    if (sampler_ != nullptr) {
        done.processes = sampler_->processes();
    }
    return {std::move(found), std::move(done)};
}

DeviceRun RunDevice::begin_search(ProgressLine& progress) {
    const Stopwatch watch;
    open(progress);
    DeviceRun done;
    done.open_seconds = watch.seconds();
    done.device = context().report();
    done.tuning = opened_->runner.sampler().tuning();
    return done;
}

void RunDevice::check(const Error& error) {
    if (error.status == Status::device_lost) {
        opened_->device->is_lost = true; // It refuses all further work.
        opened_.reset();
    }
    check_run(error, options_.device_bytes != 0);
}

void RunDevice::release_memory() {
    if (opened_) {
        opened_->runner.release_memory();
    }
}

} // namespace geodisk::tools
