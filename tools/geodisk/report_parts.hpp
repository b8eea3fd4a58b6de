// What the reports of all commands that sample tell alike.
#pragma once

#include <string>

#include <geodisk/device.hpp>
#include <geodisk/runner.hpp>

#include "common/text.hpp"
#include "geodisk/json_text.hpp"

namespace geodisk::tools {

template <typename Number>
std::string exact_text(Number value) {
    std::string text;
    append_number(text, value);
    return text;
}

Json tuning_json(const Tuning& tuning);
Json device_json(const DeviceReport& device);

} // namespace geodisk::tools
