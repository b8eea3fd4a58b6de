// Standard error where it is a terminal.
#pragma once

#include <string>

namespace geodisk::tools {

bool stderr_is_terminal();

enum class Colour { red, yellow };

/// `text` in a colour for standard error, or as it is where that is no terminal or one that is
/// dumb, and where NO_COLOR is set (https://no-color.org).
std::string coloured(const std::string& text, Colour colour);

} // namespace geodisk::tools
