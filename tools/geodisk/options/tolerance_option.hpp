// Distance that points of other programs may lie off a mesh.
#pragma once

#include <string>

namespace geodisk::tools {

class Command;

/// Adds --tolerance.
void add_tolerance_option(Command command, std::string& tolerance,
                          const std::string& group = "Options");

/// Throws UserError(usage) for what is no length.
void check_tolerance(const std::string& tolerance);

/// Returns the tolerance in mesh units on a mesh with that diagonal.
double tolerance_on(const std::string& tolerance, double diagonal);

} // namespace geodisk::tools
