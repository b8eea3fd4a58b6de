#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <geodisk/version.hpp>

#include "geodisk/checks/sample_input.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/map_run.hpp"
#include "geodisk/opened_device.hpp"
#include "geodisk/options/distance_options.hpp"
#include "geodisk/options/mesh_options.hpp"
#include "geodisk/options/run_options.hpp"
#include "geodisk/outputs/map_output.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "geodisk/reports/run_report.hpp"
#include "program/command.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kBakeExamples[] = {
    "geodisk bake spot.obj points.ply -o nearest.npz",
    "geodisk bake spot.obj points.ply -o cells.png --size 2048 --padding 8",
};

constexpr std::uint32_t kMaxTexels = 16384; // Along each side.

struct BakeOptions {
    MeshOptions mesh;
    OutputOptions out;
    RunOptions run;
    std::string samples, tolerance, size = "1024", padding = "0", style = "voronoi", depth = "8";
};

/// A map that is made, for write_outputs().
struct MapReport {
    const MeshInput& mesh;
    const std::vector<MeshWarning>& warnings; ///< Warnings about mesh and samples.
    const MapResult& result;
    std::size_t samples;
    const std::string& output;

    std::string json(double write_seconds) const;
    std::string summary(double write_seconds) const;
};

std::string MapReport::json(double write_seconds) const {
    Json document{{"version", GEODISK_VERSION_STRING},
                  {"mesh", mesh_json(mesh)},
                  {"warnings", warnings_json(warnings)},
                  {"samples", samples},
                  {"size", {result.map.width, result.map.height}},
                  {"texels",
                   {{"covered", result.covered},
                    {"overlapping", result.overlapping},
                    {"padded", result.padded},
                    {"unreached", result.unreached}}},
                  {"repeating_faces", result.repeating},
                  {"largest_distance", result.largest_distance},
                  {"error", result.error},
                  {"disks", result.done.run.disks},
                  {"windows", result.done.run.windows},
                  {"output", output}};
    return search_json(std::move(document), mesh, result.done, write_seconds);
}

std::string MapReport::summary(double write_seconds) const {
    std::ostringstream out;
    out << mesh_lines("mesh", mesh) << "texels        " << grouped(result.covered) << " of "
        << grouped(result.map.width) << " x " << grouped(result.map.height) << " have a face\n"
        << "samples       " << grouped(samples) << ", at most "
        << rounded(result.largest_distance, 6) << " away, exact to " << rounded(result.error, 2)
        << '\n';
    if (result.padded > 0) {
        out << "padding       " << counted(result.padded, "texel", "texels") << " around these\n";
    }
    if (result.overlapping > 0) {
        out << "overlaps      " << counted(result.overlapping, "texel has", "texels have")
            << " several faces; the lowest counts\n";
    }
    if (result.repeating > 0) {
        out << "repeats       " << counted(result.repeating, "face has", "faces have")
            << " texture coordinates outside of 0 to 1, which wrap around\n";
    }
    if (result.unreached > 0) {
        out << "no sample     in the parts of the mesh of "
            << counted(result.unreached, "texel", "texels") << '\n';
    }
    out << search_text(mesh, result.done, write_seconds, output, "finding samples");
    return out.str();
}

std::uint32_t parse_side(const std::string& text, std::string_view side) {
    const auto texels = parse_integer<std::uint32_t>(side);
    if (!texels || *texels < 1 || *texels > kMaxTexels) {
        fail_usage("--size takes SIDE or WIDTHxHEIGHT, each of 1 to " + std::to_string(kMaxTexels) +
                   " texels, not " + in_quotes(text));
    }
    return *texels;
}

TextureSize parse_size(const std::string& text) {
    const std::size_t by = text.find('x');
    const std::string_view size = text;
    const std::uint32_t width = parse_side(text, size.substr(0, by));
    return {width, by == std::string::npos ? width : parse_side(text, size.substr(by + 1))};
}

std::uint32_t parse_padding(const std::string& text) {
    const auto padding = parse_integer<std::uint32_t>(text);
    if (!padding || *padding > kMaxTexels) {
        fail_usage("--padding takes 0 to " + std::to_string(kMaxTexels) + " texels, not " +
                   in_quotes(text));
    }
    return *padding;
}

void check_files(const BakeOptions& options) {
    std::vector<NamedFile> read{{"the samples read", options.samples}};
    options.mesh.add_files(read, "the mesh");
    check_outputs(options.out, "the map", read, [](const Path& path) { check_writable(path); });
}

void run_bake(BakeOptions options) {
    const MapTarget target = parse_map_target(options.out.output, options.style, options.depth);
    const MapSize size{parse_size(options.size), parse_padding(options.padding)};
    options.mesh.fields.uvs = true;
    const RunnerOptions runner = options.run.runner();
    check_tolerance(options.tolerance);
    check_files(options);

    ProgressLine progress(options.out.quiet);
    const MeshInput mesh = load_mesh(options.mesh, progress);
    std::vector<MeshWarning> warnings;
    const SampleFile file =
        read_samples_silently_on(options.samples, mesh, options.tolerance, warnings, progress);
    if (file.rows.empty()) {
        fail_input(options.samples, "has no samples");
    }
    print_warnings(warnings);
    warnings.insert(warnings.begin(), mesh.warnings.begin(), mesh.warnings.end());
    RunDevice device(options.run.device, runner);
    MapResult result =
        run_map(file.rows, size, mesh, target.has_cells(), device, runner.device_bytes, progress);
    check_validation(device.context());
    const MapReport report{mesh, warnings, result, file.rows.size(), options.out.output};
    write_outputs(options.out, "the map", progress, report, [&](AtomicFile& map) {
        write_map(map, target, result.map, file.rows.size(), result.touching);
    });
}

} // namespace

void add_bake_command(Command app) {
    const Command command =
        app.add_command("bake", "Find the nearest sample for each texel of a texture, and its\n"
                                "geodesic distance");
    const auto options = std::make_shared<BakeOptions>();
    add_mesh_argument(command, options->mesh, "Mesh with texture coordinates");
    command
        .add_option("SAMPLES", options->samples, "",
                    "Samples of MESH, or points of another program, put on the\n"
                    "nearest face")
        .required();
    add_output_argument(command, options->out,
                        "Map to write: *.npz (arrays sample, distance, face), *.npy\n"
                        "(distances) or *.png (a picture)");
    command
        .add_option("--size", options->size, "SIZE",
                    "Texels along each side, or WIDTHxHEIGHT, up to 16384")
        .shows_default();
    command
        .add_option("--padding", options->padding, "N",
                    "Also fill texels up to N away from islands of the texture, from\n"
                    "the nearest texel that has a face, up to 16384")
        .shows_default();
    command
        .add_option("--style", options->style, "STYLE",
                    "What *.png shows: voronoi, cells in colours, or distance, from\n"
                    "black at samples to white at the largest")
        .offers(map_style_names())
        .shows_default();
    command
        .add_option("--depth", options->depth, "BITS",
                    "Bits of each channel of *.png: 8, or 16 for --style distance")
        .offers(map_depths())
        .shows_default();
    add_mesh_options(command, options->mesh);
    add_tolerance_option(command, options->tolerance);
    add_json_option(command, options->out);
    add_quiet_option(command, options->out);
    add_device_options(command, options->run.device);
    add_verbose_option(command, options->run.device);
    add_limit_options(command, options->run);
    command.has_footer(help_footer(kBakeExamples));
    command.calls([options] { run_bake(*options); });
}

} // namespace geodisk::tools
