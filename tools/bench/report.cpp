#include "bench/report.hpp"

#include <type_traits>

#include <nlohmann/json.hpp>

#include "program/exact_text.hpp"
#include "program/human_text.hpp"
#include "program/json_text.hpp"

namespace geodisk::bench {
namespace {

using Json = nlohmann::ordered_json;

/// Calls `visit(name, value)` for each field that every written form of a row has, in order; values
/// are strings or numbers.
template <class Visit>
void visit_fields(const Measurement& row, const Visit& visit) {
    const RunReport& run = row.run;
    visit("mesh", row.mesh);
    visit("triangles", row.triangles);
    visit("count", row.wanted);
    visit("samples", row.samples);
    visit("candidates", run.candidates);
    visit("min_distance", row.min_distance);
    visit("prepare_seconds", row.seconds.prepare);
    visit("upload_seconds", row.seconds.upload);
    visit("device_seconds", row.seconds.device);
    visit("readback_seconds", row.seconds.readback);
    visit("reference_seconds", row.seconds.reference);
    visit("device_per_reference", row.seconds.device / row.seconds.reference);
    visit("device_cpu_seconds", row.cpu_seconds.device);
    visit("reference_cpu_seconds", row.cpu_seconds.reference);
    visit("device_samples_per_second", static_cast<double>(row.samples) / row.seconds.device);
    visit("reference_samples_per_second", static_cast<double>(row.samples) / row.seconds.reference);
    for (std::size_t stage = 0; stage < kStages; ++stage) {
        // 0 unless stages are timed.
        const std::string name = to_string(static_cast<Stage>(stage));
        visit((name + "_stage_seconds").c_str(), run.stages[stage]);
    }
    visit("disks_per_sample", row.per_sample(static_cast<double>(run.disks)));
    visit("windows_per_disk", row.per_disk(static_cast<double>(run.windows)));
    visit("tested_per_disk", row.per_disk(static_cast<double>(run.tested)));
    visit("disks", run.disks);
    visit("windows", run.windows);
    visit("tested", run.tested);
    visit("trips", run.trips);           // 0 unless stages are timed,
    visit("lane_trips", run.lane_trips); // and so is this.
    visit("batches", run.batches);
    visit("dispatches", run.dispatches);
    visit("regrown", run.regrown);
    visit("starts", run.starts);
    visit("max_waiting", run.max_waiting);
    visit("longest_chain", run.longest_chain);
    visit("device_bytes", run.device_bytes);
    visit("bytes_per_candidate",
          static_cast<double>(run.device_bytes) / static_cast<double>(run.candidates));
}

/// The same for the circumstances.
template <class Visit>
void visit_fields(const Circumstances& run, const Visit& visit) {
    visit("version", run.version);
    visit("commit", run.commit);
    visit("dirty", run.is_dirty);
    visit("build_type", run.build_type);
    visit("compiler", run.compiler);
    visit("device", run.device);
    visit("driver", run.driver);
    visit("device_type", run.device_type);
    visit("cpu", run.cpu);
    visit("cores", run.cores);
    visit("date", run.date);
    visit("repeats", run.repeats);
    visit("warm_ups", run.warm_ups);
    visit("seed", run.seed);
    visit("slots", run.slots);
    visit("lanes", run.lanes);
    visit("steps", run.steps);
    visit("passes", run.passes);
    visit("batches", run.tuning.batches);
    visit("local_size", run.tuning.local_size);
    visit("slot_local_size", run.tuning.slot_local_size);
    visit("group_lanes", run.tuning.group_lanes);
    visit("pool_block", run.tuning.pool_block);
    visit("reads", std::string(to_string(run.tuning.reads)));
}

template <class Record>
void add_fields(Json& object, const Record& record) {
    visit_fields(record, [&](const char* name, const auto& value) { object[name] = value; });
}

template <class Value>
std::string value_text(const Value& value) {
    if constexpr (std::is_same_v<Value, std::string>) {
        return tools::one_line(value);
    } else if constexpr (std::is_same_v<Value, bool>) {
        return value ? "true" : "false";
    } else {
        return tools::exact_text(value);
    }
}

Json growth_json(const Series& series, const Growth& growth) {
    Json entry{{"sweep", to_string(series.sweep)},
               {"mesh", series.mesh},
               {"quantity", std::string(growth.quantity) + "_seconds"}};
    if (growth.law) {
        entry["exponent"] = growth.law->exponent;
        entry["factor"] = growth.law->factor;
        entry["r_squared"] = growth.law->r_squared;
        entry["points"] = growth.law->points;
        entry["from"] = growth.law->from;
    } else {
        entry["exponent"] = nullptr;
    }
    return entry;
}

} // namespace

std::string json_text(const Circumstances& circumstances, const std::vector<Series>& series) {
    Json document{
        {"circumstances", Json::object()}, {"rows", Json::array()}, {"growth", Json::array()}};
    add_fields(document["circumstances"], circumstances);
    for (const Series& one : series) {
        for (const Measurement& row : one.rows) {
            Json entry{{"sweep", to_string(one.sweep)}};
            add_fields(entry, row);
            document["rows"].push_back(std::move(entry));
        }
        for (const Growth& growth : one.growth) {
            document["growth"].push_back(growth_json(one, growth));
        }
    }
    return tools::json_text(document, 2) + '\n';
}

std::string csv_text(const Circumstances& circumstances, const std::vector<Series>& series) {
    std::string text;
    visit_fields(circumstances, [&](const char* name, const auto& value) {
        text += "# " + tools::csv_comment(std::string(name) + ": " + value_text(value)) + '\n';
    });
    text += "sweep";
    visit_fields(Measurement{}, [&](const char* name, const auto&) {
        text += ',';
        text += name;
    });
    text += '\n';
    for (const Series& one : series) {
        for (const Measurement& row : one.rows) {
            text += to_string(one.sweep);
            visit_fields(row, [&](const char*, const auto& value) {
                text += ',' + tools::csv_cell(value_text(value));
            });
            text += '\n';
        }
    }
    return text;
}

} // namespace geodisk::bench
