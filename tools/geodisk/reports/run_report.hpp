// Common parts of the reports of all commands that sample on a device.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "geodisk/device_run.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/method_options.hpp"
#include "geodisk/reports/json_type.hpp"

namespace geodisk::tools {

Json tuning_json(const Tuning& tuning);
/// Name, driver and type.
Json device_json(const DeviceReport& device);

/// Request and its result.
struct Drawn {
    const Method& method;
    const DeviceRun& done;
    WantedCount wanted_count;
    std::uint64_t samples;
};

/// The method with what it was given, what stopped it, and how many candidates and samples.
Json drawn_json(const Drawn& drawn);
/// "9,000", or with what was asked for where it is not that.
std::string samples_text(const Drawn& drawn);
/// Lines of candidates or darts, and the seed.
std::string candidates_text(const Drawn& drawn, std::uint64_t seed);
/// Name and value of the candidates in the header of a sample file.
std::pair<std::string, std::string> candidates_entry(const Drawn& drawn);

/// Seconds by stage, in the order of the stages.
using SecondsByStage = std::vector<std::pair<const char*, double>>;

/// Those of `before`, then from opening the device to reading the samples back, then `after`.
SecondsByStage stage_seconds(SecondsByStage before, const DeviceRun& done,
                             const SecondsByStage& after);

/// Returns the end of the JSON of a run: guard, memory, seconds, tuning, device.
Json run_json(const DeviceRun& done, const SecondsByStage& seconds);

/// Returns the report of a search on a mesh as JSON, with `document` before what all runs have.
std::string search_json(Json document, const MeshInput& mesh, const DeviceRun& done,
                        double write_seconds);

/// Returns the end of its summary, as run_text() has it.
std::string search_text(const MeshInput& mesh, const DeviceRun& done, double write_seconds,
                        const std::string& output, const std::string& work);

/// Returns the end of the summary of a run: time, also of the `work` itself, device, file.
std::string run_text(const DeviceRun& done, const SecondsByStage& seconds,
                     const std::string& output, const std::string& work = "sampling");

} // namespace geodisk::tools
