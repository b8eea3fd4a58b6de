// The words of a command line by what they are: options, their values, and arguments. CLI11 then
// only converts values. Left to itself it takes options for values, and names for commands.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "program/command.hpp"

namespace geodisk::tools {

struct CommandLine {
    std::vector<std::string> options;   ///< "--name" or "--name=value", in their order.
    std::vector<std::string> arguments; ///< Words that belong to no option, in their order.
};

/// Sorts `words`, as typed behind the name of `command`. "--" ends the options. Values may be given
/// as "--name=value", "--name value", "-nvalue" and "-n value"; a value that looks like an option
/// only with "=". Throws UserError(usage) for an unknown option and for one without its value.
CommandLine sorted_words(const CommandFacts& command, std::span<const std::string> words);

/// Returns `line` as words that mean the same wherever they are read.
std::vector<std::string> words_of(const CommandLine& line);

/// Returns true if `words` ask for help before "--".
bool asks_for_help(std::span<const std::string> words);

} // namespace geodisk::tools
