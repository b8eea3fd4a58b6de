// What the reports of all commands that sample tell alike.
#pragma once

#include <geodisk/device.hpp>
#include <geodisk/runner.hpp>

#include "geodisk/json_text.hpp"

namespace geodisk::tools {

Json tuning_json(const Tuning& tuning);
Json device_json(const DeviceReport& device);

} // namespace geodisk::tools
