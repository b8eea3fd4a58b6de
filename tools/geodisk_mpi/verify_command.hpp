// `geodisk_mpi verify`.
#pragma once

#include "program/command.hpp"

namespace geodisk::tools {

class Session;

/// Checks the distances of samples by all processes. On all but the first process it helps the
/// first one.
void add_shared_verify_command(Command app, Session& session);

} // namespace geodisk::tools
