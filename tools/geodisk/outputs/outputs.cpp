#include "geodisk/outputs/outputs.hpp"

#include <algorithm>
#include <iostream>
#include <optional>
#include <set>
#include <vector>

#include "files/samples/sample_format.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/program.hpp"
#include "program/terminal.hpp"

namespace geodisk::tools {
namespace {

/// Prints the summary for people where no data goes.
void print_text(const std::string& text, bool is_output_taken, const char* what) {
    if (is_output_taken) {
        std::cerr << plain_lines(text) << std::flush;
        return;
    }
    std::cout << plain_lines(text);
    flush_or_fail(what);
}

/// Writes `report` to the disk, then everything to streams, and last of all lets the files appear,
/// when nothing can fail any more.
void bring_out(const OutputOptions& options, std::vector<AtomicFile*> files,
               const std::string& report, const std::string& text, const char* what) {
    std::optional<AtomicFile> json;
    if (!options.json.empty()) {
        files.push_back(&json.emplace(options.json));
        json->write(report);
        json->sync();
    }
    check_interrupted();
    bool is_output_taken = false;
    for (AtomicFile* const file : files) {
        if (const auto& stream = file->stream()) {
            is_output_taken |= stream->descriptor == 1;
            file->commit();
        }
    }
    if (options.has_summary()) {
        print_text(text, is_output_taken, what);
    }
    const Uninterrupted all;
    for (AtomicFile* const file : files) {
        if (!file->stream()) {
            file->commit();
        }
    }
}

} // namespace

void check_outputs(const OutputOptions& options, const std::string& what,
                   const std::vector<NamedFile>& read, void (*check_path)(const Path&),
                   const std::vector<NamedFile>& further) {
    FilesInUse files;
    for (const NamedFile& file : read) {
        files.add_read(file);
    }
    files.add_written({what, options.output});
    for (const NamedFile& file : further) {
        files.add_written(file);
    }
    files.add_written({"the report", options.json});
    const bool is_output_taken =
        is_standard_output(options.output) || is_standard_output(options.json) ||
        std::ranges::any_of(further,
                            [](const auto& file) { return is_standard_output(file.path); });
    if (!options.quiet && !is_output_taken) {
        files.add_written({"the summary", "-"});
    }
    if (!options.output.empty() && check_path != nullptr) {
        check_path(options.output);
    } else if (!options.output.empty()) {
        check_writable(options.target().path);
    }
    if (!options.json.empty()) {
        check_writable(options.json);
    }
}

void publish(const OutputOptions& options, const std::vector<AtomicFile*>& files,
             const std::string& report, const std::string& summary) {
    bring_out(options, files, report, summary, "the summary");
}

void publish(const OutputOptions& options, const std::string& report, const std::string& result) {
    bring_out(options, {}, report, result, "the result");
}

void print_precision_note(const OutputOptions& options, std::span<const SampleRow> rows,
                          std::uint32_t dimension) {
    if (const auto note = precision_note(options.target(), rows, dimension)) {
        print_warning(options.output + ": " + *note);
    }
}

bool takes_column(const OutputOptions& options, std::string_view column) {
    const SampleFormat format = options.target().format;
    if (!facts_of(format).has_columns()) {
        print_warning(options.output + ": " + a_file(format) + " has no columns, so the column " +
                      std::string(column) + " is left out; use " +
                      listed_formats(&FormatFacts::has_columns) + " to have it");
    }
    return facts_of(format).has_columns();
}

void flush_or_fail(const std::string& what) {
    std::cout.flush();
    if (!std::cout) {
        fail_output(what + " cannot be written to standard output");
    }
}

void print_failure(const std::string& subject, const std::string& message) {
    const bool is_named = message.starts_with(subject + ": ");
    std::cerr << program_name() << ": " << one_line(is_named ? message : subject + ": " + message)
              << '\n';
}

void print_warning(const std::string& message) {
    static std::set<std::string> printed;
    if (!printed.insert(message).second) {
        return;
    }
    std::cerr << coloured(program_name() + ": warning:", Colour::yellow) << ' ' << one_line(message)
              << '\n';
}

void print_warnings(const std::vector<MeshWarning>& warnings) {
    for (const MeshWarning& warning : warnings) {
        print_warning((warning.file.empty() ? "" : warning.file + ": ") + warning.message);
    }
}

} // namespace geodisk::tools
