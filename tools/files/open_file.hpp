// Opening files by any name that the system allows, whatever its code page.
#pragma once

#include <cstdio>
#include <filesystem>

#include "files/stream_path.hpp"

namespace geodisk::tools {

/// Null, with errno set, if it cannot be opened.
std::FILE* open_to_read(const std::filesystem::path& path);

/// The same for a stream, which is opened as `path` where it is not open yet. A device that is no
/// terminal gives ENODEV.
std::FILE* open_stream_to_read(const std::filesystem::path& path, const StreamPath& stream);

} // namespace geodisk::tools
