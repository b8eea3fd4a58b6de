// How far the reading of a file is.
#pragma once

#include <cstdint>
#include <functional>

namespace geodisk::tools {

/// Called from time to time with the part of a file that has been read, 0 to 1. May throw, which
/// ends the reading. May be empty.
using ReadingProgress = std::function<void(double part)>;

/// Whether progress is due after so many records.
constexpr bool is_progress_due(std::uint64_t records) {
    return records % 65536 == 0;
}

} // namespace geodisk::tools
