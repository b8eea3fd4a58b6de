#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include <geodisk/version.hpp>

#include "geodisk/batch/batch_items.hpp"
#include "geodisk/batch/batch_log.hpp"
#include "geodisk/batch/batch_run.hpp"
#include "geodisk/batch/device_pool.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/options/batch_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/json.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kFooter = R"(Examples:
  geodisk batch meshes -o samples --count 10000
  geodisk batch bunny.obj teapot.ply -o samples --min-distance 1% --format csv
  geodisk batch list.txt -o samples --count 10000 --shard 3/16
  geodisk batch list.txt -o samples --count 10000 --resume

A manifest (paths are relative to its folder):
  # mesh              options
  bunny.ply           --count 20000
  "old scans/a.obj"   --min-distance 0.5% --weld -o scans/first
  builtin:torus-knot  --seed 7

Exit status:
  0    all meshes are done
  1    some meshes failed, see the log; the others are done
  2    wrong usage, also in a line of the manifest
  3    the folder or the manifest is missing, unreadable or names no mesh
  4    the log or the report cannot be written
  5    no Vulkan device that can run geodisk
  6    the list of meshes does not fit into memory
  7    an error or crash inside geodisk or the driver
  130  interrupted (SIGINT)
  143  terminated (SIGTERM), or 128 + signal for SIGHUP and SIGQUIT
Files of meshes that are done stay, whatever the status; --resume continues after them.)";

/// Enough that some read and write while the device samples others.
constexpr int kJobsPerDevice = 4;
/// Side by side, so that a device has work while the host looks at what came of it. With --memory,
/// which is for each run, there is one.
constexpr std::size_t kRunsPerDevice = 2;

struct BatchResult {
    std::size_t meshes = 0;  ///< Number of meshes of the shard.
    std::size_t skipped = 0; ///< Number of these that were done before.
    BatchTotals totals;
    std::vector<std::string> devices; ///< None where nothing was left to do.
    std::string log;
    int jobs = 0;
};

/// Returns the items of the shard that are not done yet.
std::vector<const BatchItem*> items_to_do(const std::vector<BatchItem>& items, const Shard& shard,
                                          const std::set<std::string>& done, BatchResult& result) {
    std::vector<const BatchItem*> left;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (!shard.has(i)) {
            continue;
        }
        ++result.meshes;
        std::error_code ignored;
        if (done.contains(items[i].command) &&
            std::filesystem::is_regular_file(Path(items[i].job.out.output), ignored)) {
            ++result.skipped;
        } else {
            left.push_back(&items[i]);
        }
    }
    return left;
}

void make_folder(const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(Path(folder), error);
    if (error) {
        fail_to_write(folder, error.message());
    }
}

void run_items(const BatchOptions& options, const std::vector<const BatchItem*>& items,
               LineLog& log, BatchResult& result) {
    ProgressLine progress(options.sample.out.quiet);
    const RunnerOptions& runner = items.front()->job.runner;
    DevicePool pool(chosen_devices(options.devices), options.sample.run.device.validate, runner,
                    runner.device_bytes == 0 ? kRunsPerDevice : 1);
    pool.open(progress);
    result.devices = pool.names();
    result.jobs = options.jobs != 0 ? options.jobs : kJobsPerDevice * static_cast<int>(pool.size());
    result.totals = run_batch(items, result.jobs, pool, log, progress);
}

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

/// Returns one JSON object and a line break.
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

/// Returns lines for people.
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

/// Returns DIR/batch.jsonl, or DIR/batch-I-of-N.jsonl for one of several shards.
std::string log_path(const BatchOptions& options, const Shard& shard) {
    const std::string name = options.shard.empty()
                                 ? "batch.jsonl"
                                 : "batch-" + std::to_string(shard.index) + "-of-" +
                                       std::to_string(shard.count) + ".jsonl";
    return (Path(options.folder) / Path(name)).string();
}

void run_batch_command(const BatchOptions& options) {
    const Shard shard = options.parsed_shard();
    const std::vector<BatchItem> items = batch_items(options);
    BatchResult result;
    result.log = log_path(options, shard);
    if (!options.resumes) {
        check_no_log(result.log);
    }
    const auto done = options.resumes ? commands_done(options.folder) : std::set<std::string>();
    check_batch_files(options, items, result.log, done);
    make_folder(options.folder);
    if (!options.sample.out.json.empty()) {
        check_writable(options.sample.out.json);
    }
    LineLog log(result.log);
    const std::vector<const BatchItem*> left = items_to_do(items, shard, done, result);
    if (!left.empty()) {
        run_items(options, left, log, result);
    }
    publish(options.sample.out, batch_json(options, result), batch_summary(options, result));
    if (result.totals.failed > 0) {
        throw UserError(ExitCode::some_failed, counted(result.totals.failed, "mesh", "meshes") +
                                                   " of " + grouped(result.meshes) + " failed; " +
                                                   result.log + " says why, and --resume retries");
    }
}

} // namespace

void add_batch_command(Command app) {
    const Command command =
        app.add_command("batch", "Sample all meshes of a folder or list, each to a file");
    const auto options = std::make_shared<BatchOptions>();
    add_batch_options(command, *options);
    command.has_footer(kFooter);
    command.calls([options] { run_batch_command(*options); });
}

} // namespace geodisk::tools
