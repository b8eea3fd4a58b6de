// A text file that grows line by line and is whole but for its last line whenever the program is
// killed.
#pragma once

#include <cstdio>
#include <string>

#include "program/path.hpp"

namespace geodisk::tools {

/// For one process at a time: another one that opens the file waits two seconds and fails. Not
/// thread-safe.
class LineLog {
  public:
    /// Opens or creates the file. A last line without an end, of a program that was killed, is
    /// taken away. Throws UserError(bad_output), like all members, with the path and the reason.
    explicit LineLog(const Path& path);
    ~LineLog();
    LineLog(const LineLog&) = delete;
    LineLog& operator=(const LineLog&) = delete;

    /// Appends `line` and a line break, and hands them to the system.
    void append(const std::string& line);

  private:
    [[noreturn]] void fail(int error) const;

    Path path_;
    std::FILE* file_ = nullptr;
};

} // namespace geodisk::tools
