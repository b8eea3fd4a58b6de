#include "geodisk/report_parts.hpp"

#include "program/human_text.hpp"

namespace geodisk::tools {

Json tuning_json(const Tuning& tuning) {
    return {{"batches", tuning.batches},
            {"local_size", tuning.local_size},
            {"slot_local_size", tuning.slot_local_size},
            {"pool_block", tuning.pool_block},
            {"reads", to_string(tuning.reads)}};
}

Json device_json(const DeviceReport& device) {
    return {
        {"name", device.name}, {"driver", driver_text(device)}, {"type", type_name(device.type)}};
}

} // namespace geodisk::tools
