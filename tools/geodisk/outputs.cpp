#include "geodisk/outputs.hpp"

#include <iostream>

#include "common/user_error.hpp"
#include "program/output_path.hpp"

namespace geodisk::tools {
namespace {

bool is_file(const std::string& path) {
    return !path.empty() && path != "-";
}

void check_pair(const NamedFile& written, const NamedFile& other) {
    if (is_file(written.path) && is_file(other.path) && is_same_file(written.path, other.path)) {
        throw UserError(ExitCode::usage,
                        written.path + ": " + written.what + " would replace " + other.what);
    }
}

} // namespace

void check_distinct(const std::vector<NamedFile>& written, const std::vector<NamedFile>& read) {
    for (std::size_t i = 0; i < written.size(); ++i) {
        for (const NamedFile& other : read) {
            check_pair(written[i], other);
        }
        for (std::size_t j = 0; j < i; ++j) {
            check_pair(written[i], written[j]);
        }
    }
}

ReportFile::ReportFile(const std::string& path, const std::string& text) {
    if (path == "-") {
        std::cout << text;
        flush_or_fail("the report");
    } else if (is_file(path)) {
        file_.emplace(path).write(text);
        file_->sync();
    }
}

void ReportFile::commit() {
    if (file_) {
        file_->commit();
    }
}

void check_report_path(const std::string& path) {
    if (is_file(path)) {
        check_writable(path);
    }
}

void flush_or_fail(const std::string& what) {
    std::cout.flush();
    if (!std::cout) {
        throw UserError(ExitCode::bad_output, what + " cannot be written to standard output");
    }
}

} // namespace geodisk::tools
