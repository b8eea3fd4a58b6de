// What the commands write besides samples, and the care that outputs take.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/atomic_file.hpp"

namespace geodisk::tools {

/// A file of the command line, and what it is to the user: "the mesh".
struct NamedFile {
    std::string what, path;
};

/// Throws UserError(usage) if a file to write is one that is read, or another one to write. An
/// empty path and "-" are no files.
void check_distinct(const std::vector<NamedFile>& written, const std::vector<NamedFile>& read);

/// A report for programs: goes to a file, or to standard output for "-", or nowhere for "".
class ReportFile {
  public:
    /// Writes `text`; a file does not appear before commit(). Throws UserError(bad_output).
    ReportFile(const std::string& path, const std::string& text);
    void commit();

  private:
    std::optional<AtomicFile> file_;
};

/// Throws UserError(bad_output) if the path given to a ReportFile cannot be written.
void check_report_path(const std::string& path);

/// Throws UserError(bad_output) if `what` did not get through to standard output.
void flush_or_fail(const std::string& what);

} // namespace geodisk::tools
