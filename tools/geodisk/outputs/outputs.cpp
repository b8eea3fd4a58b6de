#include "geodisk/outputs/outputs.hpp"

#include <algorithm>
#include <iostream>
#include <optional>

#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/terminal.hpp"

namespace geodisk::tools {
namespace {

/// An empty path and "-" are no files.
bool is_file(const std::string& path) {
    return !path.empty() && path != "-";
}

void check_pair(const NamedFile& written, const NamedFile& other) {
    if (is_file(written.path) && is_file(other.path) && is_same_file(written.path, other.path)) {
        fail_usage(written.path + ": " + written.what + " would replace " + other.what);
    }
}

/// Brings the report to the disk, as `file`, and all else to standard output. The file appears
/// under its name once nothing can fail any more.
void bring_out(const OutputOptions& options, std::optional<AtomicFile>& file,
               const std::string& report, const std::string& text, const char* what) {
    if (is_file(options.json)) {
        file.emplace(options.json).write(report);
        file->sync();
    }
    check_interrupted();
    if (options.json == "-") {
        std::cout << report;
        flush_or_fail("the report");
    }
    if (options.has_summary()) {
        std::cout << text;
        flush_or_fail(what);
    }
}

} // namespace

void check_outputs(const OutputOptions& options, const std::string& what,
                   const std::vector<NamedFile>& read, void (*check_path)(const Path&),
                   const std::vector<NamedFile>& further) {
    std::vector<NamedFile> known = read;
    const auto add = [&known](const NamedFile& written) {
        for (const NamedFile& other : known) {
            check_pair(written, other);
        }
        known.push_back(written);
    };
    add({what, options.output});
    std::ranges::for_each(further, add);
    add({"the report", options.json});
    if (!options.output.empty() && check_path != nullptr) {
        check_path(options.output);
    } else if (!options.output.empty()) {
        check_writable(options.target().path);
    }
    if (is_file(options.json)) {
        check_writable(options.json);
    }
}

void publish(const OutputOptions& options, const std::vector<AtomicFile*>& files,
             const std::string& report, const std::string& summary) {
    std::optional<AtomicFile> json;
    bring_out(options, json, report, summary, "the summary");
    const Uninterrupted all;
    for (AtomicFile* const file : files) {
        file->commit();
    }
    if (json) {
        json->commit();
    }
}

void publish(const OutputOptions& options, const std::string& report, const std::string& result) {
    std::optional<AtomicFile> json;
    bring_out(options, json, report, result, "the result");
    if (json) {
        json->commit();
    }
}

void flush_or_fail(const std::string& what) {
    std::cout.flush();
    if (!std::cout) {
        fail_output(what + " cannot be written to standard output");
    }
}

void print_failure(const std::string& subject, const std::string& message) {
    const bool is_named = message.starts_with(subject + ": ");
    std::cerr << "geodisk: " << one_line(is_named ? message : subject + ": " + message) << '\n';
}

void print_warning(const std::string& message) {
    std::cerr << coloured("geodisk: warning:", Colour::yellow) << ' ' << one_line(message) << '\n';
}

} // namespace geodisk::tools
