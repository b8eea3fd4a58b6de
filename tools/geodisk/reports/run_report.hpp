// What the reports of all commands that sample on a device tell alike.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "geodisk/device_run.hpp"
#include "geodisk/reports/json.hpp"

namespace geodisk::tools {

/// Seconds by stage, in the order of the stages.
using SecondsByStage = std::vector<std::pair<const char*, double>>;

/// Those of `before`, then from opening the device to writing the samples.
SecondsByStage stage_seconds(SecondsByStage before, const DeviceRun& done, double write_seconds);

/// What the JSON of a run ends with: guard, memory, seconds, tuning, device.
Json run_json(const DeviceRun& done, const SecondsByStage& seconds);

/// What the summary of a run ends with: time, device, file.
std::string run_text(const DeviceRun& done, const SecondsByStage& seconds,
                     const std::string& output);

} // namespace geodisk::tools
