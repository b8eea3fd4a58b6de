// Progress of reading a file.
#pragma once

#include <cstdint>
#include <functional>

namespace geodisk::tools {

/// Called from time to time with the part of a file that has been read, 0 to 1. May throw, which
/// ends the reading. May be empty.
using ReadingProgress = std::function<void(double part)>;

/// Calls `progress` if it is due after so many records, when `read` of `all` has been read.
inline void tell(const ReadingProgress& progress, std::uint64_t records, std::uint64_t read,
                 std::uint64_t all) {
    if (progress && records % 65536 == 0) {
        progress(static_cast<double>(read) / static_cast<double>(all));
    }
}

} // namespace geodisk::tools
