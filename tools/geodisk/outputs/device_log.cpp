#include "geodisk/outputs/device_log.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>

#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::chrono::seconds kBetweenLines{10};
constexpr std::size_t kLabelWidth = 14; // As in summaries.

void print_line(const char* label, const std::string& text) {
    std::cerr << padded(label, kLabelWidth) << text << '\n';
}

/// Returns the seconds of the parts of a run that took time.
std::string stages_text(const StageSeconds& stages) {
    std::string text;
    for (std::size_t i = 0; i < kStages; ++i) {
        if (stages[i] > 0) {
            text += (text.empty() ? "" : ", ") + std::string(to_string(static_cast<Stage>(i))) +
                    " " + seconds_text(stages[i]);
        }
    }
    return text.empty() ? "the queue has no timestamps" : text;
}

std::string per_disk(std::uint64_t total, std::uint32_t disks) {
    return rounded(static_cast<double>(total) / std::max(1u, disks), 3);
}

} // namespace

void DeviceLog::tell_device(const DeviceReport& device, const Tuning& tuning, double open_seconds,
                            double compile_seconds) const {
    if (!enabled_) {
        return;
    }
    print_line("device", one_line(device.name) + ", " + one_line(driver_text(device)) + ", " +
                             type_name(device.type) + "; opened in " + seconds_text(open_seconds));
    print_line("kernels", "compiled in " + seconds_text(compile_seconds) + "; work groups of " +
                              std::to_string(tuning.local_size) + ", and of " +
                              std::to_string(tuning.slot_local_size) + " for disks; reads by " +
                              to_string(tuning.reads));
}

void DeviceLog::tell_task(double min_distance, double expected) {
    if (!enabled_) {
        return;
    }
    last_told_ = std::chrono::steady_clock::now();
    print_line("run", "min distance " + rounded(min_distance, 9) + ", about " +
                          grouped(static_cast<std::uint64_t>(std::llround(expected))) +
                          " samples expected");
}

void DeviceLog::tell_progress(const Progress& state) {
    const auto now = std::chrono::steady_clock::now();
    if (!enabled_ || now - last_told_ < kBetweenLines) {
        return;
    }
    last_told_ = now;
    print_line("so far", grouped(state.accepted) + " samples, " + grouped(state.decided) + " of " +
                             grouped(state.candidates) + " candidates, " + grouped(state.disks) +
                             " disks of " + per_disk(state.windows, state.disks) + " windows");
}

void DeviceLog::tell_run(const RunReport& run) const {
    if (!enabled_) {
        return;
    }
    const RunPlan& plan = run.plan;
    print_line("work", counted(run.candidates, "candidate", "candidates") + " drawn in " +
                           counted(run.chunks, "part", "parts") + "; " +
                           counted(run.batches, "batch", "batches") + ", " +
                           counted(run.dispatches, "dispatch", "dispatches") + "; " +
                           counted(run.disks, "disk", "disks") + " of " +
                           per_disk(run.windows, run.disks) + " windows, in each " +
                           per_disk(run.tested, run.disks) + " candidates tested");
    print_line("plan", counted(plan.slots, "slot", "slots") + ", " +
                           counted(plan.lanes, "lane", "lanes") + " of " +
                           grouped(plan.window_capacity) + " windows and " +
                           grouped(plan.table_capacity / 2) + " vertices, lists of " +
                           grouped(plan.list_capacity) + " conflicts; enlarged " +
                           counted(run.regrown, "time", "times") + ", begun " +
                           counted(run.starts, "time", "times"));
    print_line("memory", size_text(run.device_bytes) + " on the device, " +
                             size_text(plan.pool_bytes()) + " of it for disks; uploaded " +
                             size_text(run.uploaded));
    print_line("time", "compiling " + seconds_text(run.seconds.compile) + ", upload " +
                           seconds_text(run.seconds.upload) + ", sampling " +
                           seconds_text(run.seconds.sample) + ", read back " +
                           seconds_text(run.seconds.readback));
    print_line("on the device", stages_text(run.stages));
}

} // namespace geodisk::tools
