// `geodisk transfer`: carries samples over to another mesh of the same connectivity.
#pragma once

namespace CLI {
class App;
}

namespace geodisk::tools {

/// Adds the subcommand `transfer` to `app`.
void add_transfer_command(CLI::App& app);

} // namespace geodisk::tools
