#include "geodisk/run_options.hpp"

#include <CLI/CLI.hpp>

#include "program/arguments.hpp"

namespace geodisk::tools {

std::uint64_t RunOptions::parsed_seed() const {
    return parse_seed("--seed", seed);
}

std::uint64_t RunOptions::pool_bytes() const {
    return parse_bytes("--memory", memory);
}

void add_run_options(CLI::App& command, RunOptions& options) {
    command.add_option("--seed", options.seed, "64-bit seed; equal seeds give equal samples")
        ->type_name("S")
        ->capture_default_str();
    command.add_option("--device", options.device, "Device by name, index or UUID (geodisk info)")
        ->type_name("NAME|INDEX");
    command
        .add_option("--memory", options.memory,
                    "Most bytes on the device for disks in progress, with\n"
                    "K, M or G; does not change the samples")
        ->type_name("BYTES")
        ->capture_default_str();
    command.add_option("--json", options.json, "Write a report as JSON, - for standard output")
        ->type_name("FILE");
    command.add_flag("--ascii", options.ascii, "Write PLY as text");
    command.add_flag("-q,--quiet", options.quiet, "No progress and no summary");
    command
        .add_flag("--validate", options.validate,
                  "Run with the Vulkan validation layer, fail on any message")
        ->group("Development");
}

} // namespace geodisk::tools
