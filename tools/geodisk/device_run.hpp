// Runs on a device, for the commands that sample.
#pragma once

#include <utility>

#include <geodisk/context.hpp>
#include <geodisk/runner.hpp>

#include "geodisk/options/run_options.hpp"
#include "geodisk/outputs/progress.hpp"

namespace geodisk::tools {

/// How a set of samples came about.
struct DeviceRun {
    DeviceReport device;
    Tuning tuning; ///< As used.
    RunReport run;
    double open_seconds = 0, compile_seconds = 0; ///< Those of the stages after are in `run`.
};

/// Opens the device of `options`, compiles there what the domain needs, and draws about `expected`
/// samples of it. Returns them and how they came about; throws UserError.
std::pair<SampleSet, DeviceRun> run_on_device(const RunOptions& options,
                                              const RunnerOptions& runner_options,
                                              const Domain& domain, double expected,
                                              ProgressLine& progress);

} // namespace geodisk::tools
