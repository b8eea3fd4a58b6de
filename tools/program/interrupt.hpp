// Stopping cleanly on SIGINT and SIGTERM.
#pragma once

namespace geodisk::tools {

/// From now on the first SIGINT or SIGTERM only sets a flag; a second one ends the program as ever.
/// Also makes writing past a file size limit an error like a full disk instead of a signal.
void install_signal_handlers();

bool is_interrupted();

/// Throws UserError with the exit status 128 + signal if a signal came.
void check_interrupted();

} // namespace geodisk::tools
