// `geodisk_mpi sample`.
#pragma once

#include "geodisk/options/sample_options.hpp"
#include "program/command.hpp"

namespace geodisk::tools {

class Session;

/// Samples a mesh by all processes and writes the samples to a file. On all but the first process
/// it helps the first one.
void add_shared_sample_command(Command app, Session& session);

} // namespace geodisk::tools
