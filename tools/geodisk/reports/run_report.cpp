#include "geodisk/reports/run_report.hpp"

#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

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

} // namespace

SecondsByStage stage_seconds(SecondsByStage before, const DeviceRun& done, double write_seconds) {
    before.insert(before.end(), {{"device", done.open_seconds},
                                 {"pipelines", done.compile_seconds},
                                 {"upload", done.run.seconds.upload},
                                 {"sample", done.run.seconds.sample},
                                 {"readback", done.run.seconds.readback},
                                 {"write", write_seconds}});
    return before;
}

Json run_json(const DeviceRun& done, const SecondsByStage& seconds) {
    Json stages = Json::object();
    for (const auto& [stage, value] : seconds) {
        stages[stage] = value;
    }
    return {{"guard", done.run.guard},
            {"device_bytes", done.run.device_bytes},
            {"seconds", stages},
            {"tuning", tuning_json(done.tuning)},
            {"device", device_json(done.device)}};
}

std::string run_text(const DeviceRun& done, const SecondsByStage& seconds,
                     const std::string& output) {
    double total = 0;
    for (const auto& [stage, value] : seconds) {
        total += value;
    }
    return "time          " + seconds_text(done.run.seconds.sample) + " sampling, " +
           seconds_text(total) + " in all\ndevice        " + one_line(done.device.name) +
           "\nfile          " + one_line(output) + '\n';
}

} // namespace geodisk::tools
