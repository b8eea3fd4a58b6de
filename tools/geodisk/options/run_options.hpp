// The options that several commands share: how to run on a device, and where results go.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <geodisk/runner.hpp>

#include "files/output/files_in_use.hpp"
#include "files/samples/sample_format.hpp"
#include "files/stream_path.hpp"
#include "geodisk/options/record_options.hpp"

namespace geodisk::tools {

class Command;

/// Outputs of a command, as given on the command line.
struct OutputOptions {
    std::string output;     ///< The samples.
    std::string json;       ///< The report for programs; "-" is standard output. Or "".
    std::string format;     ///< Format of the samples; "" for that of their extension.
    std::string columns;    ///< Names of part_columns() with commas, or "".
    std::string up;         ///< Axis that points up in a scene: "x", "y", "z", or "" to guess it.
    std::string units;      ///< Unit of lengths in a scene, or "".
    std::string pixel_size; ///< Mesh units per pixel of STAR, or "".
    RecordOptions record;
    bool ascii = false, quiet = false, is_dry_run = false;
    bool no_header = false; ///< Write samples without comments.

    /// Returns where and how to write the samples, with the unit of a scene, but not with the axis
    /// that points up. Throws UserError(usage).
    SampleTarget target() const;
    /// Throws UserError(usage) for --up and --units where nothing has them: samples in other
    /// formats without a picture.
    void check_scene(bool has_picture) const;

    /// Returns true if the results are printed for people.
    bool has_summary() const { return !quiet && !is_standard_output(json); }
};

/// Help for a file of samples to write, and for one to read that is `use`: "Samples to check".
std::string help_of_output();
std::string help_of_input(const std::string& use, const std::string& more = "");

/// Adds -o, described by `summary`.
void add_output_argument(Command command, OutputOptions& options,
                         const std::string& summary = help_of_output());

/// Adds -o and --dry-run, one of which must be given.
void add_output_or_dry_run(Command command, OutputOptions& options, const std::string& summary);

/// Throws UserError(usage) if neither was.
void check_output_or_dry_run(const OutputOptions& options);

void add_json_option(Command command, OutputOptions& options);

/// Adds --quiet, with what it leaves out.
void add_quiet_option(Command command, OutputOptions& options,
                      const std::string& summary = "No progress and no summary");

/// Adds --ascii, --no-header and --pixel-size.
void add_text_options(Command command, OutputOptions& options);

/// Adds --columns, --attributes, --normals and --frames.
void add_columns_options(Command command, OutputOptions& options);

/// Adds --up and --units.
void add_scene_options(Command command, OutputOptions& options);

/// Adds --json, --format, --up, --units, --ascii, --no-header, --pixel-size and --quiet.
void add_output_options(Command command, OutputOptions& options);

/// Device to work on, as given on the command line.
struct DeviceOptions {
    std::string device;
    bool validate = false;
    bool verbose = false; ///< Tell what it does.
};

/// Adds --validate.
void add_validate_option(Command command, DeviceOptions& options);

/// Adds --verbose.
void add_verbose_option(Command command, DeviceOptions& options);

/// Adds --device and --validate.
void add_device_options(Command command, DeviceOptions& options);

/// Options for sampling on a device, as given on the command line.
struct RunOptions {
    DeviceOptions device;
    std::string seed = "0", memory, stall_timeout;

    /// Throw UserError(usage) naming the option whose value will not do.
    std::uint64_t parsed_seed() const;
    RunnerOptions runner() const;
};

/// Adds --seed.
void add_seed_option(Command command, RunOptions& options);

/// Adds --memory and --stall-timeout.
void add_limit_options(Command command, RunOptions& options);

} // namespace geodisk::tools
