// The frame of a command line program: parses, runs, and turns every failure into one line and an
// exit status.
#pragma once

#include <CLI/CLI.hpp>

namespace geodisk::tools {

/// Parses the arguments with `app`, whose callbacks do the work, and returns the exit status of the
/// process. Prints help and version to standard output, and "NAME: MESSAGE" to standard error for
/// any exception.
int run_program(CLI::App& app, int argc, char** argv);

} // namespace geodisk::tools
