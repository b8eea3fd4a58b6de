// Commands as people repeat them.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace geodisk::tools {

/// `text` within single quotes of a POSIX shell.
std::string in_shell_quotes(std::string_view text);

/// `argument` as a word of a POSIX shell: in quotes where it needs some, and of plain characters
/// alone, as Bash reads them in $'', where it has control characters or is not UTF-8.
std::string shell_word(std::string_view argument);

/// The program's name and its arguments as a line for a shell.
std::string command_text(std::string_view program, std::span<const std::string> arguments);

} // namespace geodisk::tools
