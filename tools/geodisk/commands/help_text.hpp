// Footers for the help of commands.
#pragma once

#include <span>
#include <string>

namespace geodisk::tools {

/// Returns the examples of one command, each a line that works, and the exit statuses of all.
std::string help_footer(std::span<const char* const> examples);

} // namespace geodisk::tools
