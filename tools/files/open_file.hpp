// Opening files by any name that the system allows, whatever its code page.
#pragma once

#include <cstdio>
#include <filesystem>

namespace geodisk::tools {

/// Null, with errno set, if it cannot be opened.
std::FILE* open_to_read(const std::filesystem::path& path);

/// A file that was not there, to write. Null, with errno set, if it was, or cannot be made.
std::FILE* create_new(const std::filesystem::path& path);

} // namespace geodisk::tools
