// Manual pages of a program and of its commands, from what help tells.
#pragma once

#include <string>
#include <vector>

#include "program/command.hpp"

namespace geodisk::tools {

struct ManualPage {
    std::string name; ///< Name of the file: "geodisk-sample.1".
    std::string text; ///< In the language of man, roff.
};

/// A page for `program` and one for each of its commands.
std::vector<ManualPage> manual_pages(const CommandFacts& program, const std::string& version);

} // namespace geodisk::tools
