// `geodisk shapes`: the surfaces that need no mesh file.
#pragma once

namespace CLI {
class App;
}

namespace geodisk::tools {

/// Adds the subcommand `shapes` to `app`. When chosen, it lists the built-in surfaces on standard
/// output, or writes one of them to a PLY file; it throws UserError(bad_output) if that cannot be
/// written.
void add_shapes_command(CLI::App& app);

} // namespace geodisk::tools
