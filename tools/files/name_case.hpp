// File systems that take names which differ by case alone for one.
#pragma once

#include <filesystem>

namespace geodisk::tools {

/// Returns true if the file system at `path` does so. `path` may be a file that does not exist yet.
/// Asks the nearest folder that exists, by its own name in the other case.
bool ignores_case(const std::filesystem::path& path);

} // namespace geodisk::tools
