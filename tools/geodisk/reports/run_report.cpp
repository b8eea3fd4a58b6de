#include "geodisk/reports/run_report.hpp"

#include "geodisk/reports/json.hpp"
#include "program/exact_text.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

Json processes_json(const std::vector<ProcessReport>& processes) {
    Json all = Json::array();
    for (const ProcessReport& process : processes) {
        all.push_back({{"parts", process.parts},
                       {"own_faces", process.own_faces},
                       {"faces", process.faces},
                       {"candidates", process.candidates},
                       {"samples", process.samples},
                       {"part_bytes", process.part_bytes},
                       {"neighbours", process.neighbours},
                       {"rounds", process.rounds},
                       {"messages", process.messages},
                       {"bytes", process.bytes},
                       {"whole_runs", process.whole_runs},
                       {"border_runs", process.border_runs},
                       {"peak_bytes", process.peak_bytes}});
    }
    return all;
}

/// Returns what ended the run.
const char* stopped_by(const Drawn& drawn) {
    const bool has_all = drawn.samples == drawn.method.params.stop_count || drawn.done.cut > 0;
    return has_all                       ? "count"
           : drawn.method.throws_darts   ? "darts"
           : drawn.method.params.maximal ? "maximal"
                                         : "pool";
}

/// Less is usual where the driver has kept the shaders.
constexpr double kNotedCompiling = 1;

/// Seconds of compiling before the runs and in them.
double compile_seconds(const DeviceRun& done) {
    return done.compile_seconds + done.run.seconds.compile;
}

SecondsByStage search_seconds(const MeshInput& mesh, const DeviceRun& done, double write_seconds) {
    return stage_seconds({{"load", mesh.load_seconds}, {"prepare", mesh.prepare_seconds}}, done,
                         {{"write", write_seconds}});
}

} // namespace

Json tuning_json(const Tuning& tuning) {
    return {{"batches", tuning.batches},
            {"local_size", tuning.local_size},
            {"slot_local_size", tuning.slot_local_size},
            {"group_lanes", tuning.group_lanes},
            {"pool_block", tuning.pool_block},
            {"reads", to_string(tuning.reads)}};
}

Json device_json(const DeviceReport& device) {
    return {
        {"name", device.name}, {"driver", driver_text(device)}, {"type", type_name(device.type)}};
}

Json drawn_json(const Drawn& drawn) {
    const bool throws_darts = drawn.method.throws_darts;
    return {{"method", throws_darts ? "darts" : "pool"},
            // Each method has this or that.
            {"pool_ratio", throws_darts ? Json(nullptr) : Json(drawn.method.params.pool_ratio)},
            {"dense", drawn.method.is_dense},
            {"darts", throws_darts ? Json(drawn.done.run.candidates) : Json(nullptr)},
            {"candidates", drawn.done.run.candidates},
            {"chunks", drawn.done.run.chunks},
            {"stopped_by", stopped_by(drawn)},
            {"runs", drawn.done.runs},
            {"exact", drawn.wanted_count.is_exact},
            {"cut", drawn.done.cut},
            {"samples", drawn.samples}};
}

std::string samples_text(const Drawn& drawn) {
    std::string text = grouped(drawn.samples);
    const auto& [wanted, is_exact] = drawn.wanted_count;
    if (wanted > 0) {
        text += is_exact
                    ? " as asked for, of " + grouped(drawn.samples + drawn.done.cut) + " that fit"
                    : " of about " + grouped(static_cast<std::uint64_t>(wanted)) + " asked for";
        if (drawn.done.runs > 1) {
            text += ", in " + std::to_string(drawn.done.runs) + " runs";
        }
    } else if (drawn.samples < drawn.method.params.stop_count) {
        text +=
            " of " + grouped(drawn.method.params.stop_count) + " asked for, when the darts ran out";
    }
    return text;
}

std::string candidates_text(const Drawn& drawn, std::uint64_t seed) {
    std::string text = drawn.method.throws_darts ? "darts         " : "candidates    ";
    text += grouped(drawn.done.run.candidates);
    text += drawn.method.is_dense ? " (dense)" : "";
    text += ", seed " + std::to_string(seed) + '\n';
    return text;
}

std::pair<std::string, std::string> candidates_entry(const Drawn& drawn) {
    return {drawn.method.throws_darts ? "darts" : "pool_size",
            exact_text(drawn.done.run.candidates)};
}

SecondsByStage stage_seconds(SecondsByStage before, const DeviceRun& done,
                             const SecondsByStage& after) {
    before.insert(before.end(), {{"device", done.open_seconds},
                                 {"pipelines", compile_seconds(done)},
                                 {"upload", done.run.seconds.upload},
                                 {"sample", done.run.seconds.sample},
                                 {"readback", done.run.seconds.readback}});
    before.insert(before.end(), after.begin(), after.end());
    return before;
}

Json run_json(const DeviceRun& done, const SecondsByStage& seconds) {
    Json stages = Json::object();
    for (const auto& [stage, value] : seconds) {
        stages[stage] = value;
    }
    Json json{{"guard", done.run.guard},
              {"device_bytes", done.run.device_bytes},
              {"seconds", stages},
              {"tuning", tuning_json(done.tuning)},
              {"device", device_json(done.device)}};
    if (!done.processes.empty()) {
        json["processes"] = processes_json(done.processes);
    }
    return json;
}

std::string search_json(Json document, const MeshInput& mesh, const DeviceRun& done,
                        double write_seconds) {
    Json run = run_json(done, search_seconds(mesh, done, write_seconds));
    run.erase("guard"); // Of samples.
    document.update(run);
    return text_of(document);
}

std::string search_text(const MeshInput& mesh, const DeviceRun& done, double write_seconds,
                        const std::string& output, const std::string& work) {
    return run_text(done, search_seconds(mesh, done, write_seconds), output, work);
}

std::string run_text(const DeviceRun& done, const SecondsByStage& seconds,
                     const std::string& output, const std::string& work) {
    double total = 0;
    for (const auto& [stage, value] : seconds) {
        total += value;
    }
    std::string text = "time          " + seconds_text(done.run.seconds.sample) + ' ' + work +
                       ", " + seconds_text(total) + " in all\n";
    if (const double compiling = compile_seconds(done); compiling >= kNotedCompiling) {
        text += "compiling     " + seconds_text(compiling) +
                " for the shaders, which the driver keeps for later runs\n";
    }
    return text + "device        " + one_line(done.device.name) + "\nfile          " +
           one_line(output) + '\n';
}

} // namespace geodisk::tools
