// The variables of the environment that tell Vulkan's loader which drivers to use.
#pragma once

#include <string>

namespace geodisk {

/// Returns why such a variable may leave the loader without a driver, and what to do about it; "" if
/// none is set.
std::string driver_files_problem();

} // namespace geodisk
