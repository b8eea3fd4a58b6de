// Sampling jobs as commands.
#pragma once

#include <string>

#include "geodisk/options/sample_options.hpp"

namespace geodisk::tools {

/// Adds the options that choose samples and what their file has of them, all but its name.
void add_manifest_options(Command command, SampleOptions& options);

/// The command, as a line for a shell, that gives the same samples in the same file. Options that
/// change neither are not in it, so equal commands give equal files.
std::string sample_command(const SampleOptions& options);

} // namespace geodisk::tools
