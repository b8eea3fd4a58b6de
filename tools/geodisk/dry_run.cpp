#include "geodisk/dry_run.hpp"

#include <algorithm>
#include <cmath>

#include "geodisk/opened_device.hpp"
#include "geodisk/reports/json.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/stopwatch.hpp"

namespace geodisk::tools {
namespace {

constexpr double kPilotSeconds = 2;
constexpr double kStartSeconds = 0.5; // That say little of the rest.

/// Returns the bytes of the buffers, with as many stages at once as the device binds and `bound`
/// allows, if not 0.
std::uint64_t planned_bytes(const Sampler& sampler, const RunnerOptions& options,
                            const Domain& domain) {
    RunPlan plan = take(sampler.plan_run(domain, options.pool_bytes));
    for (;; --plan.stages) {
        auto needs = sampler.workspace_needs(domain, plan);
        const bool fits =
            needs && (options.device_bytes == 0 || needs->total() <= options.device_bytes);
        if (fits || plan.stages <= 1) {
            if (!needs) {
                check_run(needs.error(), options.device_bytes != 0);
            }
            const std::uint64_t bytes = take(std::move(needs)).total();
            return options.device_bytes == 0 ? bytes : std::min(bytes, options.device_bytes);
        }
    }
}

/// Runs the step, or what of it takes no longer than the pilot.
void run_pilot(Runner& runner, const RequestStep& step, bool is_bounded, ProgressLine& progress,
               DryRun& dry) {
    progress.begin_stage("running a pilot");
    double start_part = 0, start_seconds = 0;
    const Stopwatch watch;
    auto result = runner.sample_and_wait(step.domain, [&](const Progress& state) {
        dry.pilot_part = part_done(state, step.expected);
        dry.pilot_seconds = watch.seconds();
        if (dry.pilot_seconds < kStartSeconds) {
            start_part = dry.pilot_part;
            start_seconds = dry.pilot_seconds;
        }
        return !is_interrupted() &&
               (dry.pilot_seconds < kPilotSeconds || dry.pilot_part <= start_part);
    });
    progress.clear();
    check_interrupted();
    if (result) {
        dry.pilot_part = 1;
        dry.pilot_seconds = result->report.seconds.sample;
        dry.sample_seconds = dry.pilot_seconds;
        dry.device_bytes = result->report.device_bytes;
    } else if (result.error().status == Status::cancelled) {
        const double rate = (dry.pilot_part - start_part) / (dry.pilot_seconds - start_seconds);
        dry.sample_seconds = dry.pilot_seconds + (1 - dry.pilot_part) / rate;
    } else {
        check_run(result.error(), is_bounded);
        take(std::move(result));
    }
}

/// A count that is an estimate.
std::uint64_t whole(double count) {
    return static_cast<std::uint64_t>(std::llround(count));
}

} // namespace

DryRun dry_run_on_device(RunDevice& device, const RequestRun& request, std::uint64_t seed,
                         ProgressLine& progress) {
    const RequestStep& step = *request.step();
    DryRun dry;
    dry.min_distance = step.params.min_distance;
    dry.seed = seed;
    dry.expected = step.expected;
    dry.candidates = step.domain.stages().candidates();
    dry.compile_seconds = device.compile(step.domain, progress);
    dry.device = device.context().report();
    dry.device_bytes = planned_bytes(device.runner().sampler(), device.options(), step.domain);
    run_pilot(device.runner(), step, device.options().device_bytes != 0, progress, dry);
    check_validation(device.context());
    return dry;
}

Json dry_run_json(const DryRun& run) {
    return {{"dry_run", true},
            {"min_distance", run.min_distance},
            {"seed", run.seed},
            {"expected_samples", whole(run.expected)},
            {"expected_candidates", whole(run.candidates)},
            {"device_bytes", run.device_bytes},
            {"seconds",
             {{"pipelines", run.compile_seconds},
              {"sample", run.sample_seconds},
              {"pilot", run.pilot_seconds}}},
            {"pilot_part", run.pilot_part},
            {"device", {{"name", run.device.name}, {"driver", driver_text(run.device)}}}};
}

std::string dry_run_text(const DryRun& run) {
    const bool is_whole = run.pilot_part >= 1;
    const std::string time = is_whole ? seconds_text(run.pilot_seconds) + " sampling, measured"
                                      : "about " + seconds_text(run.sample_seconds) +
                                            " sampling, estimated from " +
                                            rounded(100 * run.pilot_part, 2) + " % of it in " +
                                            seconds_text(run.pilot_seconds);
    return "samples       about " + grouped(whole(run.expected)) +
           " expected\ncandidates    about " + grouped(whole(run.candidates)) + ", seed " +
           std::to_string(run.seed) + "\nmemory        " + (is_whole ? "" : "about ") +
           size_text(run.device_bytes) + " on the device\ntime          " + time +
           "\ndevice        " + one_line(run.device.name) +
           "\nfile          none, this was a dry run\n";
}

} // namespace geodisk::tools
