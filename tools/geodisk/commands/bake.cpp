#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "files/samples/map_file.hpp"
#include "geodisk/checks/run_warnings.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/map_run.hpp"
#include "geodisk/opened_device.hpp"
#include "geodisk/options/mesh_options.hpp"
#include "geodisk/options/run_options.hpp"
#include "geodisk/options/tolerance_option.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/map_report.hpp"
#include "picture/distinct_colors.hpp"
#include "picture/map_picture.hpp"
#include "picture/png.hpp"
#include "program/command.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kBakeExamples[] = {
    "geodisk bake spot.obj points.ply -o nearest.npz",
    "geodisk bake spot.obj points.ply -o cells.png --size 2048",
};

constexpr std::uint32_t kMaxTexels = 16384; // Along each side.

struct BakeOptions {
    MeshOptions mesh;
    OutputOptions out;
    RunOptions run;
    std::string samples, tolerance, size = "1024", style = "voronoi";
};

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

const std::vector<std::string>& style_names() {
    static const std::vector<std::string> names{"voronoi", "distance"};
    return names;
}

picture::Style parse_map_style(const std::string& text) {
    if (text != style_names()[0] && text != style_names()[1]) {
        fail_choice("--style", text, style_names());
    }
    return picture::parse_style("--style", text);
}

void check_files(const BakeOptions& options) {
    std::vector<NamedFile> read{{"the samples read", options.samples}};
    options.mesh.add_files(read, "the mesh");
    check_outputs(options.out, "the map", read, [](const Path& path) { check_writable(path); });
}

void run_bake(BakeOptions options) {
    const MapFormat format = map_format(options.out.output);
    const TextureSize size = parse_size(options.size);
    const picture::Style style = parse_map_style(options.style);
    options.mesh.fields.uvs = true;
    const RunnerOptions runner = options.run.runner();
    check_tolerance(options.tolerance);
    check_files(options);

    ProgressLine progress(options.out.quiet);
    const MeshInput mesh = load_mesh(options.mesh, progress);
    std::vector<MeshWarning> warnings;
    const HeaderEntries additions = options.mesh.additions();
    const SampleFile file =
        read_samples_silently_on(options.samples, options.mesh.mesh, mesh, &additions,
                                 options.tolerance, warnings, progress);
    if (file.rows.empty()) {
        fail_input(options.samples, "has no samples");
    }
    print_warnings(warnings);
    warnings.insert(warnings.begin(), mesh.warnings.begin(), mesh.warnings.end());
    RunDevice device(options.run.device, runner);
    const bool is_cells = format == MapFormat::png && style == picture::Style::voronoi;
    MapResult result = run_map(file.rows, size, options.mesh.mesh, mesh, is_cells, device,
                               runner.device_bytes, progress);
    check_validation(device.context());
    const MapReport report{options.mesh,      mesh, warnings, result, file.rows.size(),
                           options.out.output};
    write_outputs(options.out, "the map", progress, report, [&](AtomicFile& map) {
        if (format == MapFormat::npz) {
            write_map(map, result.map);
            return;
        }
        const picture::Pixels pixels =
            is_cells ? picture::cell_pixels(
                           result.map, picture::distinct_colors(file.rows.size(), result.touching))
                     : picture::distance_pixels(result.map);
        result.map = {size.width, size.height, {}, {}, {}}; // Room for what writing takes.
        picture::write_png(map, pixels);
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
                        "Map to write: *.npz (arrays sample, distance, face) or\n"
                        "*.png (a picture)");
    command
        .add_option("--size", options->size, "SIZE",
                    "Texels along each side, or WIDTHxHEIGHT, up to 16384")
        .shows_default();
    command
        .add_option("--style", options->style, "STYLE",
                    "What *.png shows: voronoi, cells in colours, or distance, from\n"
                    "black at samples to white at the largest")
        .offers(style_names())
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
