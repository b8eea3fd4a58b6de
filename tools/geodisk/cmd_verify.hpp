// `geodisk verify`: checks a sample file against its mesh, without a Vulkan device.
#pragma once

namespace CLI {
class App;
}

namespace geodisk::tools {

/// Adds the subcommand `verify` to `app`. When chosen, it prints what it found on standard output
/// and throws UserError(violation) if samples are too close or off the mesh.
void add_verify_command(CLI::App& app);

} // namespace geodisk::tools
