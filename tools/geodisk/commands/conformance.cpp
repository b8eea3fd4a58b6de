#include <memory>
#include <string>
#include <vector>

#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/conformance/golden_set.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/conformance_report.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kConformanceExamples[] = {
    "geodisk conformance",
    "geodisk conformance --device 1 -o record.json",
};

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
