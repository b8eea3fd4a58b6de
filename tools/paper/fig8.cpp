// Fig. 8: as many samples on a surface at several resolutions (section 5.7).

#include "paper/commands.hpp"
#include "paper/device.hpp"
#include "paper/options.hpp"
#include "paper/outputs.hpp"
#include "paper/painter.hpp"
#include "program/arguments.hpp"
#include "program/human_text.hpp"

namespace geodisk::paper {
namespace {

struct Options {
    CommonOptions common;
    std::vector<std::string> meshes;
    std::string device;
    std::string count = "700";
    PanelSize size;
};

void run(const Options& options) {
    Outputs outputs(options.common.out, "fig8");
    const double count = tools::parse_count("--count", options.count);
    const std::vector<PaperMesh> meshes = load_meshes(options.meshes);
    const PictureParams panel = square_panel(options.size);
    Device device(options.device, /* graphics */ true);
    const Painter painter(device.context());
    std::vector<Pixels> panels;

    Table table(
        {"mesh", "triangles", "area", "radius", "samples", "rho", "least", "most", "seconds"});
    LinePlot plot;
    plot.title = "Packing density of " + options.count + " samples by triangles";
    plot.x_label = "triangles";
    plot.y_label = "rho";
    plot.is_linear_y = true;
    plot.lines.push_back({"mean of " + std::to_string(options.common.repeats), 0, false, {}});
    plot.lines.push_back({"least", 1, true, {}});
    plot.lines.push_back({"most", 2, true, {}});
    for (const PaperMesh& mesh : meshes) {
        const SampleParams params = params_for(mesh, count, kDefaultPoolRatio, options.common.seed);
        const DeviceRun result = device.measure(mesh, params, options.common.repeats);
        panels.push_back(painter.surface(
            mesh, disks_of(places_of(device.sample(mesh, params)), params.min_distance), panel));
        const auto triangles = static_cast<double>(mesh.prepared.statistics().triangles);
        table.add({mesh.name, tools::fixed(triangles, 0), tools::rounded(mesh.area(), 6),
                   tools::rounded(params.min_distance / 2, 6), tools::fixed(result.samples, 1),
                   tools::fixed(result.rho, 4), tools::fixed(result.min_rho, 4),
                   tools::fixed(result.max_rho, 4), tools::fixed(result.seconds, 4)});
        plot.lines[0].points.push_back({triangles, result.rho});
        plot.lines[1].points.push_back({triangles, result.min_rho});
        plot.lines[2].points.push_back({triangles, result.max_rho});
    }
    outputs.add_table(
        table,
        {"device " + device.name(), "count " + options.count,
         options.common.text() + ", seconds are medians, samples and rho means"},
        "About " + options.count + " samples at several resolutions, on " +
            tools::one_line(device.name()) + ", " + std::to_string(options.common.repeats) +
            " runs each",
        "The paper: 700 samples on Bunny with 1.4k, 14k and 144k triangles look alike;"
        "\nrho is between 0.70 and 0.76 in all cases.");
    outputs.add_plot("", plot);
    outputs.add_picture("", side_by_side(panels));
    outputs.write();
}

} // namespace

void add_fig8(tools::Command app) {
    add_figure<Options>(
        app, "fig8", "Fig. 8: as many samples on a surface at several resolutions, on a device", 10,
        run, [](tools::Command command, Options& options) {
            add_meshes(command, options.meshes);
            command.add_option("-n,--count", options.count, "N", "Target number of samples")
                .shows_default();
            add_panel_size(command, options.size);
            add_device(command, options.device);
        });
}

} // namespace geodisk::paper
