#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/context.hpp>
#include <geodisk/sampler.hpp>
#include <geodisk/version.hpp>

#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/commit.hpp"
#include "geodisk/conformance/golden_set.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/run_report.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/table.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kConformanceExamples[] = {
    "geodisk conformance",
    "geodisk conformance --device 1 -o record.json",
};

/// Refers to what it is given, which must outlive it.
class ConformanceReport {
  public:
    ConformanceReport(const DeviceReport& device, const Tuning& tuning,
                      std::span<const GoldenSet> sets, std::span<const FoundSet> found)
        : device_(device), tuning_(tuning), sets_(sets), found_(found) {}

    /// Number of sets that are as they should be.
    std::size_t same() const;

    /// The conformance record: one JSON object and a line break.
    std::string json() const;

    std::string summary() const;

    /// The sets as found.
    std::string lines() const;

  private:
    const DeviceReport& device_;
    const Tuning& tuning_;
    std::span<const GoldenSet> sets_;
    std::span<const FoundSet> found_;
};

/// "2026-11-26", in universal time.
std::string today() {
    const std::chrono::year_month_day day{
        std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now())};
    const auto two = [](unsigned value) { return (value < 10 ? "0" : "") + std::to_string(value); };
    return std::to_string(int(day.year())) + '-' + two(unsigned(day.month())) + '-' +
           two(unsigned(day.day()));
}

std::string verdict(const GoldenSet& set, const FoundSet& found) {
    if (!found.error.empty()) {
        return "failed: " + found.error;
    }
    return found.is(set) ? "same" : "different";
}

std::size_t ConformanceReport::same() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < sets_.size(); ++i) {
        if (found_[i].is(sets_[i])) {
            ++count;
        }
    }
    return count;
}

std::string ConformanceReport::json() const {
    Json sets = Json::array();
    for (std::size_t i = 0; i < sets_.size(); ++i) {
        const FoundSet& found = found_[i];
        const bool failed = !found.error.empty();
        sets.push_back({{"job", sets_[i].job},
                        {"same", found.is(sets_[i])},
                        {"expected_fingerprint", sets_[i].fingerprint},
                        {"expected_samples", sets_[i].samples},
                        {"fingerprint", failed ? Json(nullptr) : Json(found.fingerprint)},
                        {"samples", failed ? Json(nullptr) : Json(found.samples)},
                        {"chunks", failed ? Json(nullptr) : Json(found.chunks)},
                        {"sample_seconds", failed ? Json(nullptr) : Json(found.seconds)},
                        {"error", failed ? Json(found.error) : Json(nullptr)}});
    }
    Json device = device_json(device_);
    device["vendor_id"] = device_.vendor_id;
    device["device_id"] = device_.device_id;
    device["subgroup_size"] = device_.limits.subgroup_size;
    device["rounds_natively"] = device_.rounds_natively;
    return text_of(Json{{"geodisk_version", GEODISK_VERSION_STRING},
                        {"commit", kCommit},
                        {"date", today()},
                        {"device", std::move(device)},
                        {"tuning", tuning_json(tuning_)},
                        {"sets", sets_.size()},
                        {"same", same()},
                        {"results", std::move(sets)}});
}

std::string ConformanceReport::summary() const {
    Table table({"job", "samples", "fingerprint", "verdict"});
    for (std::size_t i = 0; i < sets_.size(); ++i) {
        const FoundSet& found = found_[i];
        const bool failed = !found.error.empty();
        table.add({sets_[i].job, failed ? "" : grouped(found.samples), found.fingerprint,
                   verdict(sets_[i], found)});
    }
    return "device  " + one_line(device_.name) + "\ndriver  " + one_line(driver_text(device_)) +
           "\n\n" + table.text() + '\n' + grouped(same()) + " of " + grouped(sets_.size()) +
           " sets are the same as on every other device\n";
}

std::string ConformanceReport::lines() const {
    std::string text;
    for (std::size_t i = 0; i < sets_.size(); ++i) {
        const std::string samples = std::to_string(found_[i].samples);
        text += (found_[i].error.empty() ? found_[i].fingerprint : std::string(16, '?')) +
                std::string(9 - std::min<std::size_t>(8, samples.size()), ' ') + samples + "  " +
                sets_[i].job + '\n';
    }
    return text;
}

struct ConformanceOptions {
    DeviceOptions device;
    OutputOptions out;
    std::string sets; ///< File of sets to check; "" for the golden ones.
    bool prints_sets = false;
};

void run_conformance(const ConformanceOptions& options) {
    check_outputs(options.out, "the record", {{"the sets", options.sets}});
    const std::vector<GoldenSet> sets =
        options.sets.empty() ? golden_sets() : read_sets(options.sets);
    ProgressLine progress(options.out.quiet);
    RunDevice device(options.device, {});
    std::vector<FoundSet> found;
    found.reserve(sets.size());
    for (const GoldenSet& set : sets) {
        found.push_back(find_set(set, options.device, device, progress));
    }
    progress.clear();
    device.open(progress); // Where the last run has lost it.
    const ConformanceReport report(device.context().report(), device.runner().sampler().tuning(),
                                   sets, found);
    if (options.prints_sets) {
        publish(options.out, report.json(), report.lines());
        return;
    }
    publish(options.out, report.json(), report.summary());
    if (report.same() != sets.size()) {
        throw UserError(ExitCode::violation, grouped(sets.size() - report.same()) + " of " +
                                                 counted(sets.size(), "set", "sets") +
                                                 " differ from the known ones on this device");
    }
}

} // namespace

void add_conformance_command(Command app) {
    const Command command =
        app.add_command("conformance", "Check that a device gives the same samples as all others");
    const auto options = std::make_shared<ConformanceOptions>();
    command.add_option("-o,--output", options->out.json, "FILE",
                       "Write device, driver and each set as JSON, - for standard output");
    add_device_options(command, options->device);
    add_verbose_option(command, options->device);
    add_quiet_option(command, options->out);
    command.add_option("--sets", options->sets, "FILE",
                       "Check the sets in FILE instead, in the form of --print-sets",
                       "Development");
    command.add_flag("--print-sets", options->prints_sets,
                     "Print one set of this device per line: fingerprint, number of\n"
                     "samples, job",
                     "Development");
    command.has_footer(help_footer(kConformanceExamples));
    command.calls([options] { run_conformance(*options); });
}

} // namespace geodisk::tools
