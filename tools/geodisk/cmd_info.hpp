// `geodisk info`: which Vulkan devices this machine has and whether they can run geodisk.
#pragma once

namespace CLI {
class App;
}

namespace geodisk::tools {

/// Adds the subcommand `info` to `app`. When chosen, it writes the list of devices to standard
/// output, as text or with --json as JSON, and then throws UserError(no_device) if none is usable,
/// or UserError(bad_output) if the list cannot be written.
void add_info_command(CLI::App& app);

} // namespace geodisk::tools
