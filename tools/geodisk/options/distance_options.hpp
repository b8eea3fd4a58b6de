// Lengths for samples of files: the distance that they are to keep, and how far off a mesh they may
// lie.
#pragma once

#include <optional>
#include <string>

#include "program/arguments.hpp"

namespace geodisk::tools {

class Command;

/// Distance that samples are to keep, where a command line tells another than the file.
struct DistanceOptions {
    std::string min_distance, radius;

    /// Twice the radius, if that is given. Throws UserError(usage) naming the option.
    std::optional<Length> parsed() const;
};

/// Adds --min-distance and --radius.
void add_distance_options(Command command, DistanceOptions& options);

/// Adds --tolerance.
void add_tolerance_option(Command command, std::string& tolerance,
                          const std::string& group = "Options");

/// Throws UserError(usage) for what is no length.
void check_tolerance(const std::string& tolerance);

/// Returns the distance that points of other programs may lie off a mesh in mesh units on a mesh
/// with that diagonal.
double tolerance_on(const std::string& tolerance, double diagonal);

} // namespace geodisk::tools
