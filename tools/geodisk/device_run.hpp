// Runs on a device, for the commands that sample.
#pragma once

#include <cstdint>
#include <functional>

#include <geodisk/context.hpp>
#include <geodisk/domain.hpp>
#include <geodisk/runner.hpp>

#include "geodisk/options/run_options.hpp"
#include "geodisk/outputs/progress.hpp"

namespace geodisk::tools {

/// How a set of samples came about.
struct DeviceRun {
    DeviceReport device;
    Tuning tuning;                                ///< As used.
    double min_distance = 0;                      ///< As used.
    std::uint32_t runs = 0;                       ///< At this distance and those tried before.
    RunReport run;                                ///< With the seconds of all runs.
    double open_seconds = 0, compile_seconds = 0; ///< Those of the stages after are in `run`.
};

/// What came of a run, and the device it was on.
struct DeviceResult {
    SampleSet set;
    DeviceRun done;
    Context context;
};

/// What there is to sample at a distance, and about how many samples that gives.
struct Task {
    Domain domain;
    double expected;
};
using TaskAt = std::function<Task(double min_distance)>;

/// Throws UserError for an error of a run that --memory can help with, which was `bounded` by it.
void check_run(const Error& error, bool bounded);

/// Opens the device of `options`, compiles there what the domain needs, and samples it. Where a
/// number of samples is wanted, not 0, and another comes out, it tries other distances
/// (CountSearch) and takes the nearest. The device can draw as well, where `graphics` is set.
/// Throws UserError.
DeviceResult run_on_device(const RunOptions& options, const RunnerOptions& runner_options,
                           const TaskAt& task_at, double min_distance, double wanted,
                           ProgressLine& progress, bool graphics = false);

} // namespace geodisk::tools
