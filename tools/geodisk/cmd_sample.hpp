// `geodisk sample`: samples a mesh on a Vulkan device and writes the samples to a file.
#pragma once

namespace CLI {
class App;
}

namespace geodisk::tools {

/// Adds the subcommand `sample` to `app`. When chosen, it writes the sample file and, if asked, the
/// JSON report, or throws UserError and writes neither.
void add_sample_command(CLI::App& app);

} // namespace geodisk::tools
