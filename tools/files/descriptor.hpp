// Descriptors that no child process inherits.
#pragma once

#include <filesystem>

namespace geodisk::tools {

/// Returns a copy of `descriptor`, or -1 with errno set.
int copy_descriptor(int descriptor);

/// Opens a file with `flags` of open(2), so that no other process that opens it in this way has it
/// at the same time. Returns -1 with errno set: EWOULDBLOCK if another process has it. A file
/// system without locks lets both have it.
int open_alone(const std::filesystem::path& path, int flags);

} // namespace geodisk::tools
