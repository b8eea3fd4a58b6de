// The files and texts that commands leave behind, and the care that these take.
#pragma once

#include <string>
#include <vector>

#include "files/output_file.hpp"
#include "geodisk/options/run_options.hpp"
#include "geodisk/outputs/progress.hpp"
#include "program/stopwatch.hpp"

namespace geodisk::tools {

/// Finds out before the work that it would be in vain. Throws UserError: `usage` if a file to
/// write, of which the samples are called `what`, is one that is read or the other one;
/// `bad_output` if one cannot be written.
void check_outputs(const OutputOptions& options, const std::string& what,
                   const std::vector<NamedFile>& read);

/// Brings the report for programs to the disk, where `samples` are already, and prints the summary
/// for people; only then do files appear under their names. Throws UserError(bad_output).
void publish(const OutputOptions& options, AtomicFile& samples, const std::string& report,
             const std::string& summary);

/// The same without samples: the report, then `result` for people.
void publish(const OutputOptions& options, const std::string& report, const std::string& result);

/// Writes the samples of a run, with `write(file)`, and publishes them with `report`.
template <class Report, class Write>
void write_outputs(const OutputOptions& options, ProgressLine& progress, const Report& report,
                   const Write& write) {
    progress.begin_stage("writing the samples");
    AtomicFile samples(options.output);
    const double seconds = seconds_of([&] {
        write(samples);
        samples.sync();
    });
    progress.clear();
    publish(options, samples, report.json(seconds), report.summary(seconds));
}

/// Throws UserError(bad_output) if `what` did not get through to standard output.
void flush_or_fail(const std::string& what);

/// "geodisk: warning: MESSAGE" on standard error.
void print_warning(const std::string& message);

} // namespace geodisk::tools
