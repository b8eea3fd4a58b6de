#include "geodisk/outputs/outputs.hpp"

#include <iostream>
#include <optional>

#include "files/sample_file.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

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

/// A report for programs: goes to a file, or to standard output for "-", or nowhere for "".
class ReportFile {
  public:
    ReportFile(const std::string& path, const std::string& text) {
        if (path == "-") {
            std::cout << text;
            flush_or_fail("the report");
        } else if (is_file(path)) {
            file_.emplace(path).write(text);
            file_->sync();
        }
    }

    /// A file does not appear before.
    void commit() {
        if (file_) {
            file_->commit();
        }
    }

  private:
    std::optional<AtomicFile> file_;
};

void print(const OutputOptions& options, const std::string& text, const char* what) {
    if (options.has_summary()) {
        std::cout << text;
        flush_or_fail(what);
    }
}

} // namespace

void check_outputs(const OutputOptions& options, const std::string& what,
                   const std::vector<NamedFile>& read) {
    const NamedFile samples{what, options.output};
    const NamedFile report{"the report", options.json};
    for (const NamedFile& other : read) {
        check_pair(samples, other);
    }
    for (const NamedFile& other : read) {
        check_pair(report, other);
    }
    check_pair(report, samples);
    if (!options.output.empty()) {
        check_output_path(options.output);
    }
    if (is_file(options.json)) {
        check_writable(options.json);
    }
}

void publish(const OutputOptions& options, AtomicFile& samples, const std::string& report,
             const std::string& summary) {
    ReportFile json(options.json, report);
    check_interrupted();
    samples.commit();
    json.commit();
    print(options, summary, "the summary");
}

void publish(const OutputOptions& options, const std::string& report, const std::string& result) {
    ReportFile(options.json, report).commit();
    print(options, result, "the result");
}

void flush_or_fail(const std::string& what) {
    std::cout.flush();
    if (!std::cout) {
        fail_output(what + " cannot be written to standard output");
    }
}

void print_warning(const std::string& message) {
    std::cerr << "geodisk: warning: " << one_line(message) << '\n';
}

} // namespace geodisk::tools
