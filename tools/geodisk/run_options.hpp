// The options of every command that samples on a device.
#pragma once

#include <cstdint>
#include <string>

namespace CLI {
class App;
}

namespace geodisk::tools {

/// As given on the command line.
struct RunOptions {
    std::string seed = "0", device, memory = "256M", json;
    bool ascii = false, quiet = false, validate = false;

    /// Throw UserError(usage) naming the option whose value will not do.
    std::uint64_t parsed_seed() const;
    std::uint64_t pool_bytes() const;
};

void add_run_options(CLI::App& command, RunOptions& options);

} // namespace geodisk::tools
