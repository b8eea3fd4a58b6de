// File systems that take names which differ by case alone for one.
#pragma once

#include <filesystem>

namespace geodisk::tools {

/// Whether it does so where `path` is, or will be: asked of the nearest folder that is there, by
/// its own name in the other case.
bool ignores_case(const std::filesystem::path& path);

} // namespace geodisk::tools
