// What the commands that sample leave behind.
#pragma once

#include <iostream>
#include <string>

#include "common/atomic_file.hpp"
#include "geodisk/device_run.hpp"
#include "geodisk/outputs.hpp"
#include "geodisk/run_options.hpp"

namespace geodisk::tools {

/// Brings the samples, which `write(file)` puts into the file at `output`, and the report to the
/// disk before anything appears under its name; then prints the summary.
template <class Report, class Write>
void write_outputs(const std::string& output, const RunOptions& run, Report& report,
                   ProgressLine& progress, const Write& write) {
    progress.begin_stage("writing the samples");
    AtomicFile samples(output);
    timed(report.seconds.write, [&] {
        write(samples);
        samples.sync();
    });
    progress.clear();

    ReportFile json(run.json, run.json.empty() ? "" : json_text(report));
    check_interrupted();
    samples.commit();
    json.commit();
    if (!run.quiet && run.json != "-") {
        print_summary(std::cout, report);
        flush_or_fail("the summary");
    }
}

} // namespace geodisk::tools
