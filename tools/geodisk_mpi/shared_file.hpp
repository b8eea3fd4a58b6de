// SharedFile: a file that several processes write, each its own bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include <geodisk/status.hpp>

namespace geodisk::tools {

class SharedFile {
  public:
    /// Opens a file of another process, which has written so many bytes. Does nothing if there is
    /// none at this path, or it has another size: that of another machine.
    SharedFile(const std::filesystem::path& path, std::uint64_t size);
    ~SharedFile();
    SharedFile(const SharedFile&) = delete;
    SharedFile& operator=(const SharedFile&) = delete;

    bool is_open() const { return descriptor_ >= 0; }

    /// Writes bytes from `offset` on, and brings them to the disk. Errors: `internal`, with the
    /// reason alone.
    Result<Done> write(std::uint64_t offset, std::string_view bytes) const;

  private:
    int descriptor_ = -1;
};

} // namespace geodisk::tools
