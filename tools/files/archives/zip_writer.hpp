// ZIP archives of files that are stored as they are.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "files/output/output_file.hpp"

namespace geodisk::tools {

/// Writes an archive whose bytes follow from the names and contents of its files alone: all are of
/// 1 January 1980, the first day that the format knows.
class ZipWriter {
  public:
    explicit ZipWriter(AtomicFile& file) : file_(file) {}

    /// Throws UserError(bad_output), like finish(), where the archive would reach 4 GiB, beyond
    /// which there is another format.
    void add(std::string_view name, std::string_view content);

    /// The last call.
    void finish();

  private:
    void write(std::string_view bytes);

    AtomicFile& file_;
    std::string directory_;
    std::uint16_t count_ = 0;
    std::uint64_t offset_ = 0;
};

} // namespace geodisk::tools
