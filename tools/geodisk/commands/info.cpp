
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <geodisk/context.hpp>
#include <geodisk/kernel_report.hpp>
#include <geodisk/sampler.hpp>
#include <geodisk/version.hpp>

#include "files/tuning_file.hpp"
#include "files/vulkan_environment.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/opened_device.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/json.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"
#include "program/table.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kInfoExamples[] = {
    "geodisk info",
    "geodisk info --json devices.json",
};

/// Kernels that --kernels is about.
struct KernelsOptions {
    std::string device;
    std::string reads; ///< "" for what suits the device.
};

struct InfoOptions {
    OutputOptions out; ///< Just where JSON goes.
    bool kernels = false;
    KernelsOptions of_kernels;
};

std::string version_text(std::uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + '.' +
           std::to_string(VK_API_VERSION_MINOR(version)) + '.' +
           std::to_string(VK_API_VERSION_PATCH(version));
}

std::string timestamp_text(const DeviceReport& report) {
    if (report.timestamp_valid_bits == 0)
        return "none";
    return std::to_string(report.timestamp_valid_bits) + " bits, " +
           rounded(report.limits.timestamp_period, 6) + " ns per tick";
}

void print_device(std::ostream& out, std::size_t index, const DeviceReport& report,
                  bool is_default) {
    const DeviceLimits& limits = report.limits;
    out << index << "  " << one_line(report.name) << (is_default ? "  [default]\n" : "\n")
        << "   type             " << type_name(report.type) << '\n'
        << "   Vulkan           " << version_text(report.api_version) << '\n'
        << "   driver           " << one_line(driver_text(report)) << '\n'
        << "   UUID             " << uuid_text(report.uuid) << '\n'
        << "   memory           " << size_text(report.largest_device_local_heap)
        << " in the largest device-local heap\n"
        << "   storage buffers  " << limits.max_storage_buffers_per_stage << " per stage, "
        << size_text(limits.max_storage_buffer_range) << " each\n"
        << "   workgroup        " << limits.max_workgroup_invocations << " invocations, "
        << limits.max_workgroup_size_x << " in x, " << size_text(limits.max_shared_memory_size)
        << " shared memory, subgroups of " << limits.subgroup_size << '\n'
        << "   push constants   " << size_text(limits.max_push_constants_size) << '\n'
        << "   timestamps       " << timestamp_text(report) << '\n'
        << "   float rounding   "
        << (report.rounds_natively ? "exact as on the host" : "within the bounds of Vulkan") << '\n'
        << "   runs geodisk     " << (report.usable() ? "yes" : "no:") << '\n';
    for (const std::string& reason : report.reasons_against) {
        out << "                    " << one_line(reason) << '\n';
    }
}

Json to_json(std::size_t index, const DeviceReport& report) {
    const DeviceLimits& limits = report.limits;
    return Json{
        {"index", index},
        {"name", report.name},
        {"type", type_name(report.type)},
        {"api_version", version_text(report.api_version)},
        {"uuid", uuid_text(report.uuid)},
        {"vendor_id", report.vendor_id},
        {"device_id", report.device_id},
        {"driver",
         {{"id", static_cast<std::int64_t>(report.driver_id)},
          {"name", report.driver_name},
          {"info", report.driver_info},
          {"version", report.driver_version}}},
        {"limits",
         {{"max_storage_buffer_range", limits.max_storage_buffer_range},
          {"max_memory_allocation_size", limits.max_memory_allocation_size},
          {"min_storage_buffer_offset_alignment", limits.min_storage_buffer_offset_alignment},
          {"min_texel_buffer_offset_alignment", limits.min_texel_buffer_offset_alignment},
          {"max_texel_buffer_elements", limits.max_texel_buffer_elements},
          {"non_coherent_atom_size", limits.non_coherent_atom_size},
          {"max_memory_allocation_count", limits.max_memory_allocation_count},
          {"max_storage_buffers_per_stage", limits.max_storage_buffers_per_stage},
          {"max_workgroup_invocations", limits.max_workgroup_invocations},
          {"max_workgroup_size_x", limits.max_workgroup_size_x},
          {"max_workgroup_count_x", limits.max_workgroup_count_x},
          {"max_shared_memory_size", limits.max_shared_memory_size},
          {"max_push_constants_size", limits.max_push_constants_size},
          {"subgroup_size", limits.subgroup_size},
          {"timestamp_period", limits.timestamp_period}}},
        {"largest_device_local_heap", report.largest_device_local_heap},
        {"compute_queue_family", json_of(report.compute_queue_family)},
        {"graphics_queue_family", json_of(report.graphics_queue_family)},
        {"timestamp_valid_bits", report.timestamp_valid_bits},
        {"rounds_natively", report.rounds_natively},
        {"usable", report.usable()},
        {"reasons_against", report.reasons_against},
    };
}

void print_text(std::ostream& out, const std::vector<DeviceReport>& reports,
                std::optional<std::size_t> best, const std::vector<std::string>& left_out) {
    for (std::size_t i = 0; i < reports.size(); ++i) {
        if (i > 0) {
            out << '\n';
        }
        print_device(out, i, reports[i], best == i);
    }
    const char* label = "\ndrivers left out    ";
    for (const std::string& driver : left_out) {
        out << std::exchange(label, "                    ") << one_line(driver) << '\n';
    }
}

std::string json_of_all(const std::vector<DeviceReport>& reports, std::optional<std::size_t> best,
                        const std::vector<std::string>& left_out) {
    Json devices = Json::array();
    for (std::size_t i = 0; i < reports.size(); ++i)
        devices.push_back(to_json(i, reports[i]));
    const Json document{{"geodisk_version", GEODISK_VERSION_STRING},
                        {"default_device", json_of(best)},
                        {"devices", std::move(devices)},
                        {"left_out_drivers", left_out}};
    return text_of(document);
}

void run_info(const OutputOptions& out) {
    const Result<std::vector<DeviceReport>> listed = list_devices();
    const std::vector<DeviceReport> reports = listed ? *listed : std::vector<DeviceReport>{};
    const std::string device = listed ? device_of_environment() : "";
    const Result<std::size_t> chosen = select_device(reports, device);
    const std::optional<std::size_t> best = chosen ? std::optional(*chosen) : std::nullopt;

    std::ostringstream text;
    const std::vector<std::string> left_out = missing_drivers(reports);
    print_text(text, reports, best, listed ? left_out : std::vector<std::string>());
    publish(out, json_of_all(reports, best, left_out), text.str());
    if (!listed) {
        take_device(Result<std::size_t>(listed.error()));
    }
    if (!chosen && !device.empty()) {
        take(Result<std::size_t>(chosen), kDeviceVariable);
    }
    if (!chosen) {
        throw UserError(ExitCode::no_device, "none of these Vulkan devices can run geodisk");
    }
}

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

/// Prints what the device's driver reports about the kernels that it has compiled. Throws
/// UserError(no_device) if it reports nothing.
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

} // namespace

void add_info_command(Command app) {
    const Command command =
        app.add_command("info", "List the Vulkan devices and whether they can run geodisk");
    const auto options = std::make_shared<InfoOptions>();
    const Option json =
        command
            .add_option("--json", options->out.json, "FILE",
                        "Write JSON to FILE; without FILE, or with -, print JSON only")
            .may_lack_value();
    const Option kernels =
        command.add_flag("--kernels", options->kernels,
                         "Compile the kernels on one device instead, and print the driver's\n"
                         "statistics, such as registers and spills",
                         "Development");
    command
        .add_option("--device", options->of_kernels.device, "NAME|INDEX",
                    "Device for --kernels, by name, index or UUID", "Development")
        .needs(kernels);
    command
        .add_option("--reads", options->of_kernels.reads, "WAY",
                    "Variant of the kernels: auto, storage or texels (default auto)", "Development")
        .offers({"auto", "storage", "texels"})
        .needs(kernels);
    command.has_footer(help_footer(kInfoExamples));
    command.calls([options, json] { // Owns them, as the options refer to them.
        if (json.is_given() && options->out.json.empty()) {
            options->out.json = "-";
        }
        check_outputs(options->out, "the list", {});
        if (options->kernels) {
            print_kernels(options->of_kernels, options->out);
        } else {
            run_info(options->out);
        }
    });
}

} // namespace geodisk::tools
