// The axis that points up in pictures, as a command line tells it.
#pragma once

#include <optional>
#include <string>

#include "picture/view.hpp"

namespace geodisk::tools {

class Command;

/// As given on the command line.
struct UpOption {
    std::string axis; ///< "" where a picture chooses.

    /// Throws UserError(usage) naming the option.
    std::optional<picture::Up> parsed() const;
};

/// Adds --up.
void add_up_option(Command command, UpOption& option);

} // namespace geodisk::tools
