// Runs on a device, for the commands that sample.
#pragma once

#include <chrono>
#include <string>
#include <type_traits>
#include <utility>

#include <geodisk/context.hpp>
#include <geodisk/runner.hpp>

#include "geodisk/progress.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {

/// Runs `work` and adds its seconds to `seconds`.
template <typename Work>
auto timed(double& seconds, const Work& work) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto add_seconds = [&] {
        seconds += std::chrono::duration<double>(Clock::now() - start).count();
    };
    if constexpr (std::is_void_v<decltype(work())>) {
        work();
        add_seconds();
    } else {
        auto result = work();
        add_seconds();
        return result;
    }
}

/// As --device and --validate ask; adds to `seconds`.
Context open_device(const std::string& device, bool validate, double& seconds,
                    ProgressLine& progress);

/// `options` with the tuning that is kept for the device.
RunnerOptions tuned(RunnerOptions options, const DeviceReport& device);

/// Draws how far a run is that should give about `expected` samples, and stops it on a signal.
ProgressCallback show_progress(ProgressLine& progress, double expected);

/// A runner whose pipelines for the domain are compiled; adds to `seconds`.
Runner open_runner(const Context& context, const RunnerOptions& options, const Domain& domain,
                   double& seconds, ProgressLine& progress);

/// Throws UserError for an error of a run that --memory can help with.
void check_run(const Error& error);

/// What a run returned.
template <class T>
T take_run(Result<T>&& result, ProgressLine& progress) {
    progress.clear();
    check_interrupted();
    if (!result) {
        check_run(result.error());
    }
    return take(std::move(result));
}

/// Throws UserError if the validation layer had something to say.
void check_validation(const Context& context);

} // namespace geodisk::tools
