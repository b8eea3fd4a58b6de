// Output files that appear complete or not at all, streams that are written to once all is known,
// and finding out before long work that one could not be written.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "files/output/output_target.hpp"
#include "program/path.hpp"
#include "program/temporary_files.hpp"

namespace geodisk::tools {

/// Writes to a temporary file beside the target that commit() moves into its place, with the rights
/// of what it replaces. Without commit() the temporary file is removed, if not by this process then
/// by the next that writes the same target, and an existing target stays as it was.
///
/// A stream, such as "-", a pipe or a device, is never replaced: commit() writes all bytes to it,
/// behind what is there.
class AtomicFile {
  public:
    /// Throws UserError(bad_output), like all members, with the path and the system's reason, and
    /// for what output_target() refuses.
    explicit AtomicFile(const Path& path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(std::string_view bytes);

    /// Hands all bytes to the system, and returns the temporary file, for other processes to write
    /// further ones. Returns "" for a stream.
    std::filesystem::path share();

    /// Brings all bytes to the disk, so that of several files none is committed when one cannot be
    /// written.
    void sync();

    /// Takes `path`, in the folder of the target, as another name for the file if nothing has that
    /// name: the file stands there at once, and goes again without commit(). Returns false, and
    /// changes nothing, if there is something.
    bool claim(const Path& path);

    /// Gives up the name that claim() took.
    void release() noexcept;

    /// Syncs, renames and closes. The last call. A pipe that nobody reads any more makes an error
    /// without a message.
    void commit();

    /// Returns the stream that it is, such as "-", a pipe or a device.
    const std::optional<StreamPath>& stream() const noexcept { return target_.stream; }

  private:
    [[noreturn]] void fail(int error) const;
    void write_to_stream();
    void close() noexcept;
    void discard() noexcept;

    Path given_;
    OutputTarget target_;
    std::filesystem::path temporary_;
    NotedTemporary noted_;
    std::filesystem::path claimed_; ///< "" unless claim() took a name.
    NotedTemporary noted_claim_;
    std::FILE* file_ = nullptr;
    std::string bytes_; ///< For a stream.
};

/// Throws UserError(bad_output) if nothing can be written to `path`. Changes nothing there.
void check_writable(const Path& path);

} // namespace geodisk::tools
