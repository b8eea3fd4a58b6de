// `geodisk box`: samples in a box of R^n.
#pragma once

namespace CLI {
class App;
}

namespace geodisk::tools {

/// Adds the subcommand; its callback does the work and throws UserError on failure.
void add_box_command(CLI::App& app);

} // namespace geodisk::tools
