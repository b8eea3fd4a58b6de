#include "geodisk/reports/batch_report.hpp"

#include <cmath>
#include <map>
#include <sstream>

#include <geodisk/version.hpp>

#include "geodisk/reports/json.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

double meshes_per_hour(const BatchTotals& totals) {
    constexpr double kHour = 3600;
    return totals.seconds > 0 ? static_cast<double>(totals.done) * kHour / totals.seconds : 0;
}

/// "llvmpipe" or "2 of NVIDIA H100, llvmpipe".
std::string devices_text(const std::vector<std::string>& devices) {
    std::map<std::string, std::size_t> counts;
    for (const std::string& device : devices) {
        ++counts[device];
    }
    std::string text;
    for (const auto& [name, count] : counts) {
        text += (text.empty() ? "" : ", ") + (count > 1 ? std::to_string(count) + " of " : "") +
                one_line(name);
    }
    return text;
}

/// "meshes", or "a.obj and 2 more".
std::string inputs_text(const std::vector<std::string>& inputs) {
    return inputs.front() +
           (inputs.size() > 1 ? " and " + grouped(inputs.size() - 1) + " more" : "");
}

} // namespace

std::string batch_json(const BatchOptions& options, const BatchResult& result) {
    const BatchTotals& totals = result.totals;
    const Shard shard = options.parsed_shard();
    return text_of({{"version", GEODISK_VERSION_STRING},
                    {"input", options.inputs.size() == 1 ? Json(options.inputs.front())
                                                         : Json(options.inputs)},
                    {"output", options.folder},
                    {"log", result.log},
                    {"shard", {{"index", shard.index}, {"count", shard.count}}},
                    {"jobs", result.jobs},
                    {"meshes", result.meshes},
                    {"ok", totals.done},
                    {"failed", totals.failed},
                    {"skipped", result.skipped},
                    {"with_warnings", totals.warned},
                    {"samples", totals.samples},
                    {"seconds", totals.seconds},
                    {"meshes_per_hour", meshes_per_hour(totals)},
                    {"devices", result.devices}});
}

std::string batch_summary(const BatchOptions& options, const BatchResult& result) {
    const BatchTotals& totals = result.totals;
    std::ostringstream out;
    out << "meshes        " << grouped(result.meshes) << " of "
        << one_line(inputs_text(options.inputs));
    if (!options.shard.empty()) {
        out << ", shard " << options.shard;
    }
    out << ": " << grouped(totals.done) << " ok, " << grouped(totals.failed) << " failed, "
        << grouped(result.skipped) << " skipped\n";
    if (totals.warned > 0) {
        out << "              " << grouped(totals.warned) << " with warnings, see the log\n";
    }
    if (totals.done > 0) {
        out << "samples       " << grouped(totals.samples) << '\n'
            << "time          " << seconds_text(totals.seconds) << ", "
            << grouped(static_cast<std::uint64_t>(std::llround(meshes_per_hour(totals))))
            << " meshes per hour\n";
    }
    if (!result.devices.empty()) {
        out << "device        " << devices_text(result.devices) << '\n';
    }
    out << "log           " << one_line(result.log) << '\n';
    return out.str();
}

} // namespace geodisk::tools
