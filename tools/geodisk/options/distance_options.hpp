// The distance that samples of a file are to keep, where a command line tells another than the
// file.
#pragma once

#include <optional>
#include <string>

#include "program/arguments.hpp"

namespace geodisk::tools {

class Command;

/// As given on the command line.
struct DistanceOptions {
    std::string min_distance, radius;

    /// Twice the radius, if that is given. Throws UserError(usage) naming the option.
    std::optional<Length> parsed() const;
};

/// Adds --min-distance and --radius.
void add_distance_options(Command command, DistanceOptions& options);

} // namespace geodisk::tools
