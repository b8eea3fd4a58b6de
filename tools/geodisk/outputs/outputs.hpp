// The files and texts that commands leave behind, and the care that these take.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "files/output_file.hpp"
#include "files/sample_file.hpp"
#include "geodisk/options/run_options.hpp"
#include "geodisk/outputs/progress.hpp"
#include "program/stopwatch.hpp"

namespace geodisk::tools {

/// Finds out before the work that it would be in vain. Throws UserError: `usage` if a file to
/// write, of which the output is called `what`, is one that is read or the other one; `bad_output`
/// if one cannot be written, and what `check_path` throws of the output, if there is any.
void check_outputs(const OutputOptions& options, const std::string& what,
                   const std::vector<NamedFile>& read,
                   void (*check_path)(const Path&) = check_output_path);

/// Brings the report for programs to the disk, where `output` is already, and prints the summary
/// for people; only then do files appear under their names. Throws UserError(bad_output).
void publish(const OutputOptions& options, AtomicFile& output, const std::string& report,
             const std::string& summary);

/// The same without a file: the report, then `result` for people.
void publish(const OutputOptions& options, const std::string& report, const std::string& result);

/// Writes what a command makes, "the samples" or so, with `write(file)`, and publishes it with
/// `report`.
template <class Report, class Write>
void write_outputs(const OutputOptions& options, std::string_view what, ProgressLine& progress,
                   const Report& report, const Write& write) {
    progress.begin_stage("writing " + std::string(what));
    AtomicFile file(options.output);
    const double seconds = seconds_of([&] {
        write(file);
        file.sync();
    });
    progress.clear();
    publish(options, file, report.json(seconds), report.summary(seconds));
}

/// Throws UserError(bad_output) if `what` did not get through to standard output.
void flush_or_fail(const std::string& what);

/// "geodisk: warning: MESSAGE" on standard error.
void print_warning(const std::string& message);

} // namespace geodisk::tools
