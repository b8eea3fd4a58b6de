// Output files that appear complete or not at all, and finding out before long work that one could
// not be written.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "program/path.hpp"

namespace geodisk::tools {

/// Writes to a temporary file beside `target` that commit() moves into its place. Without commit()
/// the temporary file is removed and an existing target stays as it was.
class AtomicFile {
  public:
    /// Throws UserError(bad_output), like all members, with the path and the system's reason.
    explicit AtomicFile(const Path& target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(std::string_view bytes);

    /// Brings all bytes to the disk, so that of several files none is committed when one cannot be
    /// written.
    void sync();

    /// Syncs, closes and renames. The last call.
    void commit();

  private:
    [[noreturn]] void fail(int error) const;
    void discard() noexcept;

    std::filesystem::path target_;
    std::filesystem::path temporary_;
    std::FILE* file_ = nullptr;
};

/// Whether both paths lead to the same file, also where neither exists yet.
bool is_same_file(const Path& a, const Path& b);

/// Throws UserError(bad_output) if no file can be made at `path`. Changes nothing there.
void check_writable(const Path& path);

} // namespace geodisk::tools
