// Message of the program when it crashes: whether it or the driver did.
#pragma once

namespace geodisk::tools {

/// From now on a crash removes temporary files, names on standard error the library that it came
/// from, and ends the program with ExitCode::internal, as does a driver that ends the process
/// itself. Handlers of others, such as sanitizers, stay. Does nothing on systems other than Linux.
/// `program` must stay.
void install_crash_handlers(const char* program);

/// To be called when main() is about to return: no exit after that is the driver's.
void expect_exit();

} // namespace geodisk::tools
