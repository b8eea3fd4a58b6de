// Forecasts of runs, for the commands that sample.
#pragma once

#include <cstdint>
#include <string>

#include "geodisk/device_run.hpp"
#include "geodisk/reports/json_type.hpp"

namespace geodisk::tools {

/// Forecast of a job: its samples, time and memory.
struct DryRun {
    DeviceReport device;
    double min_distance = 0; ///< The first that is tried, where a count chooses it.
    std::uint64_t seed = 0;
    double expected = 0;   ///< Samples, about.
    double candidates = 0; ///< Candidates that the pool expects, or darts.
    std::uint64_t device_bytes = 0;
    double compile_seconds = 0;
    double pilot_seconds = 0;
    double pilot_part = 0;     ///< Part of the run that the pilot did, up to 1.
    double sample_seconds = 0; ///< Seconds of the run, if the rest goes on as the pilot did.
};

/// Compiles on the device what the first step of a request needs, and begins it: a pilot that ends
/// when it is complete, or after about two seconds. Throws UserError.
DryRun dry_run_on_device(RunDevice& device, const RequestRun& request, std::uint64_t seed,
                         ProgressLine& progress);

/// For programs.
Json dry_run_json(const DryRun& run);
/// Lines of a summary, from the samples on.
std::string dry_run_text(const DryRun& run);

} // namespace geodisk::tools
