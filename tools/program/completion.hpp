// Scripts by which shells complete the commands, options, values and files of a program.
#pragma once

#include <string>

#include "program/command.hpp"

namespace geodisk::tools {

/// For bash, with or without the package bash-completion.
std::string bash_completion(const CommandFacts& program, const std::string& usual);

/// For zsh, as a file `_NAME` in a folder of its `fpath`, or by `source`.
std::string zsh_completion(const CommandFacts& program, const std::string& usual);

} // namespace geodisk::tools
