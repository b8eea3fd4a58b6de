#include "geodisk/options/run_options.hpp"

#include "files/samples/sample_format.hpp"
#include "program/arguments.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr double kLeastPixel = 1e-6, kLargestPixel = 1e6; // Angstroms; tomograms have 1 to 20.

} // namespace

SampleTarget OutputOptions::target() const {
    SampleTarget result = sample_target(output, format, ascii);
    result.has_header = !no_header;
    result.metres_per_unit = units.empty() ? 1 : parse_units("--units", units);
    if (!pixel_size.empty()) {
        if (result.format != SampleFormat::star) {
            fail_usage("--pixel-size is for samples in *.star");
        }
        result.pixel_size = parse_ratio("--pixel-size", pixel_size, kLeastPixel, kLargestPixel);
    }
    return result;
}

void OutputOptions::check_scene(bool has_picture) const {
    if (output.empty() || (up.empty() && units.empty()) || facts_of(target().format).is_scene()) {
        return;
    }
    const std::string scenes = listed_formats(&FormatFacts::is_scene, "*.", " and ");
    if (!units.empty()) {
        fail_usage("--units is for samples in " + scenes);
    }
    const auto frames = record.frame_style();
    if (!has_picture && !(frames && frames->has_world())) {
        fail_usage("--up is for samples in " + scenes +
                   ", for pictures, and for --frames=upright or --frames=PART");
    }
}

std::string help_of_output() {
    const auto has_none = [](const FormatFacts& format) { return !format.has_columns(); };
    return wrapped("File to write: " + listed_formats(nullptr, "*.") + "; " +
                   listed_formats(has_none, "*.", " and ") + " have no columns");
}

std::string help_of_input(const std::string& use, const std::string& more) {
    const auto has_points = [](const FormatFacts& format) {
        return format.read != nullptr && !format.has_columns();
    };
    return wrapped(use + ": " + listed_formats(&FormatFacts::is_read_back, "*.") +
                   ", or points of another program, also *.npy, " +
                   listed_formats(has_points, "*.", " and ") + more);
}

void add_output_argument(Command command, OutputOptions& options, const std::string& summary) {
    command.add_option("-o,--output", options.output, "OUT", summary).required();
}

void add_output_or_dry_run(Command command, OutputOptions& options, const std::string& summary) {
    command.add_option("-o,--output", options.output, "OUT", summary);
    command.add_flag("--dry-run", options.is_dry_run,
                     "Write no samples; estimate their number, memory and time\n"
                     "in a pilot run of about two seconds");
}

void check_output_or_dry_run(const OutputOptions& options) {
    if (options.output.empty() && !options.is_dry_run) {
        fail_usage("--output is required");
    }
}

void add_json_option(Command command, OutputOptions& options) {
    command.add_option("--json", options.json, "FILE",
                       "Write a report as JSON, - for standard output");
}

void add_quiet_option(Command command, OutputOptions& options, const std::string& summary) {
    command.add_flag("-q,--quiet", options.quiet, summary);
}

void add_text_options(Command command, OutputOptions& options) {
    command.add_flag("--ascii", options.ascii, "Write PLY, PCD or VTP as text");
    command.add_flag("--no-header", options.no_header,
                     "Write no comments with mesh, seed and so on, for programs that\n"
                     "read plain CSV; geodisk verify then needs --min-distance");
    command.add_option("--pixel-size", options.pixel_size, "A",
                       "Divide coordinates by the pixel size in *.star: the mesh is in\n"
                       "angstroms then (default: the mesh is in pixels)");
}

void add_columns_options(Command command, OutputOptions& options) {
    command.add_option("--columns", options.columns, "LIST",
                       "Add columns with the number of each sample's part (connected\n"
                       "component), material or group, or of its mesh, primitive or\n"
                       "node of glTF: a list of part,material,group,mesh,...");
    add_record_options(command, options.record);
}

void add_scene_options(Command command, OutputOptions& options) {
    const std::string scenes = listed_formats(&FormatFacts::is_scene, "*.", " and ");
    command
        .add_option("--up", options.up, "AXIS",
                    wrapped("Axis that points up in " + scenes +
                            ", in a picture, and for --frames: x, y or z (default: y for a mesh of "
                            "glTF, else a guess; else z for --frames, which guess nothing). glTF "
                            "is turned, as y points up there"))
        .offers({"x", "y", "z"});
    command.add_option("--units", options.units, "UNIT",
                       wrapped("Unit of the mesh in " + scenes +
                               ": mm, cm, m, km, in, ft or so many metres (default m)"));
}

void add_output_options(Command command, OutputOptions& options) {
    add_json_option(command, options);
    command
        .add_option(
            "--format", options.format, "NAME",
            wrapped("Write " + listed_formats(nullptr, "") + ", ignoring the extension of OUT"))
        .offers(sample_formats());
    add_scene_options(command, options);
    add_text_options(command, options);
    add_quiet_option(command, options);
}

std::uint64_t RunOptions::parsed_seed() const {
    return parse_seed("--seed", seed);
}

RunnerOptions RunOptions::runner() const {
    constexpr double kWeek = 604800;
    RunnerOptions options;
    if (!memory.empty()) {
        options.device_bytes = parse_bytes("--memory", memory);
    }
    if (!stall_timeout.empty()) {
        options.stall_seconds = parse_ratio("--stall-timeout", stall_timeout, 0.1, kWeek);
    }
    return options;
}

void add_validate_option(Command command, DeviceOptions& options) {
    command.add_flag("--validate", options.validate,
                     "Use the Vulkan validation layer; fail on any message", "Development");
}

void add_verbose_option(Command command, DeviceOptions& options) {
    command.add_flag("-v,--verbose", options.verbose,
                     "Print to standard error what the device does");
}

void add_device_options(Command command, DeviceOptions& options) {
    command.add_option("--device", options.device, "NAME|INDEX",
                       "Device by name, index or UUID (geodisk info; default\n"
                       "GEODISK_DEVICE, else the best device)");
    add_validate_option(command, options);
}

void add_seed_option(Command command, RunOptions& options) {
    command.add_option("--seed", options.seed, "S", "64-bit seed; equal seeds give equal samples")
        .shows_default();
}

void add_limit_options(Command command, RunOptions& options) {
    command.add_option("--memory", options.memory, "BYTES",
                       "Maximum bytes on the device, with K, M or G; does not\n"
                       "change the result");
    command.add_option("--stall-timeout", options.stall_timeout, "SECONDS",
                       "Abort if the device does not respond for SECONDS\n"
                       "(default 120; CPU 600)");
}

} // namespace geodisk::tools
