// Output files that appear complete or not at all, and finding out before long work that one could
// not be written.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "files/output_target.hpp"
#include "program/path.hpp"
#include "program/temporary_files.hpp"

namespace geodisk::tools {

/// Writes to a temporary file beside the target that commit() moves into its place, with the rights
/// of what it replaces. Without commit() the temporary file is removed, if not by this process then
/// by the next that writes the same target, and an existing target stays as it was.
class AtomicFile {
  public:
    /// Throws UserError(bad_output), like all members, with the path and the system's reason, and
    /// for what output_target() refuses.
    explicit AtomicFile(const Path& path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(std::string_view bytes);

    /// Brings all bytes to the disk, so that of several files none is committed when one cannot be
    /// written.
    void sync();

    /// Syncs, renames and closes. The last call.
    void commit();

  private:
    [[noreturn]] void fail(int error) const;
    void close() noexcept;
    void discard() noexcept;

    Path given_;
    OutputTarget target_;
    std::filesystem::path temporary_;
    NotedTemporary noted_;
    std::FILE* file_ = nullptr;
};

/// Whether both paths lead to the same file, also where neither exists yet.
bool is_same_file(const Path& a, const Path& b);

/// Throws UserError(bad_output) if no file can be made at `path`. Changes nothing there.
void check_writable(const Path& path);

} // namespace geodisk::tools
