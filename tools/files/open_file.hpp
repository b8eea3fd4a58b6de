// Opening files by any name that the system allows, whatever its code page.
#pragma once

#include <cstdio>
#include <filesystem>

namespace geodisk::tools {

/// Null, with errno set, if it cannot be opened.
std::FILE* open_to_read(const std::filesystem::path& path);

} // namespace geodisk::tools
