#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include <geodisk/context.hpp>
#include <geodisk/kernel_report.hpp>
#include <geodisk/sampler.hpp>
#include <geodisk/version.hpp>

#include "files/tuning_file.hpp"
#include "files/vulkan_environment.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/opened_device.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/json_type.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"
#include "program/table.hpp"

namespace geodisk::tools {
namespace {

/// No count or size of a kernel is as large; NVIDIA's driver puts other things there.
constexpr double kBeyondSize = 0x1p32;

/// "" for what is no value.
std::string value_text(const KernelStatistic& statistic) {
    return std::visit(
        [](auto value) -> std::string {
            using Value = decltype(value);
            if (static_cast<double>(value) >= kBeyondSize)
                return "";
            if constexpr (std::is_same_v<Value, bool>)
                return value ? "yes" : "no";
            else if constexpr (std::is_same_v<Value, double>)
                return rounded(value, 6);
            else
                return std::to_string(value);
        },
        statistic.value);
}

/// Returns the names in all reports, in the order of the driver.
std::vector<std::string> statistic_names(const std::vector<KernelReport>& reports) {
    std::vector<std::string> names;
    for (const KernelReport& report : reports) {
        for (const KernelStatistic& statistic : report.statistics) {
            if (std::find(names.begin(), names.end(), statistic.name) == names.end())
                names.push_back(statistic.name);
        }
    }
    return names;
}

/// One word a line: names are longer than values.
std::string heading(std::string name) {
    std::replace(name.begin(), name.end(), ' ', '\n');
    return name;
}

/// A table with a column for each statistic that the driver gives.
std::string kernels_text(const std::vector<KernelReport>& reports) {
    const std::vector<std::string> names = statistic_names(reports);
    std::vector<std::string> columns{"kernel", "variant", "executable", "subgroup\nsize"};
    for (const std::string& name : names)
        columns.push_back(heading(name));
    Table table(columns);
    for (const KernelReport& report : reports) {
        std::vector<std::string> row{report.kernel, report.variant, report.executable,
                                     std::to_string(report.subgroup_size)};
        for (const std::string& name : names) {
            const auto& all = report.statistics;
            const auto found = std::find_if(all.begin(), all.end(), [&](const auto& statistic) {
                return statistic.name == name;
            });
            row.push_back(found != all.end() ? value_text(*found) : "");
        }
        table.add(row);
    }
    constexpr std::size_t kNamesToTheLeft = 3;
    return table.text(kNamesToTheLeft);
}

/// An array with an object for each executable.
Json kernels_json(const std::vector<KernelReport>& reports) {
    Json kernels = Json::array();
    for (const KernelReport& report : reports) {
        Json statistics = Json::object();
        for (const KernelStatistic& statistic : report.statistics)
            std::visit(
                [&](auto value) {
                    const bool is_size = static_cast<double>(value) < kBeyondSize;
                    statistics[statistic.name] = is_size ? Json(value) : Json(nullptr);
                },
                statistic.value);
        kernels.push_back({{"kernel", report.kernel},
                           {"variant", report.variant},
                           {"executable", report.executable},
                           {"subgroup_size", report.subgroup_size},
                           {"statistics", statistics}});
    }
    return kernels;
}

Reads parsed_reads(const std::string& name) {
    if (name.empty())
        return Reads::automatic;
    const std::optional<Reads> reads = reads_named(name);
    if (!reads)
        fail_choice("--reads", name, std::vector<std::string>{"auto", "storage", "texels"});
    return *reads;
}

} // namespace

void print_kernels(const KernelsOptions& options, const OutputOptions& out) {
    SamplerOptions sampler_options;
    sampler_options.tuning.reads = parsed_reads(options.reads);
    ContextOptions context_options;
    context_options.device = chosen_device(options.device);
    context_options.pipeline_statistics = true;
    const Context context = take_device(Context::create(context_options));
    const DeviceReport& report = context.report();
    const Tuning kept = load_tuning(report).value_or(Tuning{}); // As `sample` uses it.
    sampler_options.tuning = overridden(kept, sampler_options.tuning);
    const Sampler sampler = take(Sampler::create(context.device(), sampler_options));
    const std::vector<KernelReport> reports = take(sampler.report_kernels());
    const Json document{{"geodisk_version", GEODISK_VERSION_STRING},
                        {"device", report.name},
                        {"driver", driver_text(report)},
                        {"reads", to_string(sampler.tuning().reads)},
                        {"kernels", kernels_json(reports)}};
    const std::string text = "device  " + one_line(report.name) + "\ndriver  " +
                             one_line(driver_text(report)) + "\nreads   " +
                             to_string(sampler.tuning().reads) + "\n\n" + kernels_text(reports);
    publish(out, text_of(document), text);
}

} // namespace geodisk::tools
