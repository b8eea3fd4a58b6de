#include <optional>
#include <string>
#include <vector>

#include <geodisk/context.hpp>
#include <geodisk/sampler.hpp>
#include <geodisk/version.hpp>

#include "files/tuning_file.hpp"
#include "files/vulkan_environment.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/opened_device.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/kernel_report.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools {
namespace {

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
