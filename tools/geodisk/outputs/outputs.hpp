// The files and texts that commands leave behind, and the care that these take.
#pragma once

#include <deque>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/output/output_file.hpp"
#include "files/samples/sample_file.hpp"
#include "geodisk/options/run_options.hpp"
#include "geodisk/outputs/progress.hpp"
#include "program/stopwatch.hpp"

namespace geodisk::tools {

/// A file that a command writes besides its output.
struct FurtherFile {
    std::string path; ///< "" for none.
    std::function<void(AtomicFile&)> write;
};

/// Finds out before the work that it would be in vain. Throws UserError: `usage` if a file to
/// write, of which the output is called `what`, is one that is read or another one; `bad_output`
/// if one cannot be written, and what `check_path` throws of the output, if there is any; without
/// it, these are samples. What is `further` written is checked elsewhere but for its name.
void check_outputs(const OutputOptions& options, const std::string& what,
                   const std::vector<NamedFile>& read, void (*check_path)(const Path&) = nullptr,
                   const std::vector<NamedFile>& further = {});

/// Brings the report for programs to the disk, where `files` are already, and prints the summary
/// for people; only then do files appear under their names. Throws UserError(bad_output).
void publish(const OutputOptions& options, const std::vector<AtomicFile*>& files,
             const std::string& report, const std::string& summary);

/// The same without a file: the report, then `result` for people.
void publish(const OutputOptions& options, const std::string& report, const std::string& result);

/// Settles the names of files, the output first, that are written already.
using NameFiles = std::function<void(const std::vector<AtomicFile*>& files)>;

/// Writes what a command makes, "the samples" or so, with `write(file)`, and what else, has
/// `name_files` settle the names if there is one, and publishes all with `report`.
template <class Report, class Write>
void write_outputs(const OutputOptions& options, std::string_view what, ProgressLine& progress,
                   const Report& report, const Write& write,
                   const std::vector<FurtherFile>& further = {}, const NameFiles& name_files = {}) {
    progress.begin_stage("writing " + std::string(what));
    std::deque<AtomicFile> files;
    std::vector<AtomicFile*> written;
    const auto write_file = [&](const std::string& path, const auto& bytes) {
        written.push_back(&files.emplace_back(path));
        bytes(files.back());
        files.back().sync();
    };
    const double seconds = seconds_of([&] {
        write_file(options.output, write);
        for (const FurtherFile& other : further) {
            if (!other.path.empty()) {
                write_file(other.path, other.write);
            }
        }
    });
    progress.clear();
    if (name_files) {
        name_files(written);
    }
    publish(options, written, report.json(seconds), report.summary(seconds));
}

/// Warns of samples that their file holds otherwise than they are.
void print_precision_note(const OutputOptions& options, std::span<const SampleRow> rows,
                          std::uint32_t dimension);

/// Returns true if the output can hold a column of that name; else warns that it is left out.
bool takes_column(const OutputOptions& options, std::string_view column);

/// Throws UserError(bad_output) if `what` did not get through to standard output.
void flush_or_fail(const std::string& what);

/// "geodisk: SUBJECT: MESSAGE" on standard error, the subject once, for what fails while other
/// things go on.
void print_failure(const std::string& subject, const std::string& message);

/// "NAME: warning: MESSAGE", NAME that of the program, on standard error, once for each message.
void print_warning(const std::string& message);

/// The same with warnings about files.
void print_warnings(const std::vector<MeshWarning>& warnings);

} // namespace geodisk::tools
