// Fig. 3: samples of several densities on surfaces (section 5).
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
    NumberList counts{"", {"1000", "5000", "10000"}};
    PanelSize size;
};

void run(const Options& options) {
    Outputs outputs(options.common.out, "fig3", /* has_plots */ false);
    const std::vector<double> counts = options.counts.counts();
    const PictureParams panel = square_panel(options.size);
    const std::vector<PaperMesh> meshes = load_meshes(options.meshes);
    Device device(options.device, /* graphics */ true);
    const Painter painter(device.context());
    Table table({"mesh", "triangles", "minimum distance", "samples", "rho"});
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const PaperMesh& mesh = meshes[i];
        std::vector<Pixels> panels;
        for (const double count : counts) {
            const SampleParams params =
                params_for(mesh, count, kDefaultPoolRatio, options.common.seed);
            const SampleSet set = device.sample(mesh, params);
            const auto samples = static_cast<double>(set.samples.size());
            table.add(
                {mesh.name, std::to_string(mesh.prepared.statistics().triangles),
                 tools::rounded(params.min_distance, 6), tools::fixed(samples, 0),
                 tools::fixed(packing_density(mesh.area(), params.min_distance, samples), 3)});
            panels.push_back(
                painter.surface(mesh, disks_of(places_of(set), params.min_distance), panel));
        }
        outputs.add_picture(numbered(i, meshes.size()), side_by_side(panels));
    }
    outputs.add_table(table,
                      {"device " + device.name(), "seed " + std::to_string(options.common.seed)},
                      "Samples of several densities, a picture per mesh with all of them",
                      "The paper: about 1,000, 5,000 and 10,000 samples on each model. Disks have"
                      "\nhalf of the minimum distance as radius, by exact geodesic distance in each"
                      "\npixel; where two overlapped, the picture would be orange.");
    outputs.write();
}

} // namespace

void add_fig3(tools::Command app) {
    add_figure<Options>(app, "fig3",
                        "Fig. 3: pictures of samples of several densities, on a device", 1, run,
                        [](tools::Command command, Options& options) {
                            add_meshes(command, options.meshes);
                            add_list(command, options.counts, "--counts", "Sample counts");
                            add_panel_size(command, options.size);
                            add_device(command, options.device);
                        });
}

} // namespace geodisk::paper
