// Fig. 11: radii that vary over a surface (section 5.5).
#include <algorithm>
#include <cmath>
#include <limits>

#include <geodisk/radius_field.hpp>

#include "paper/commands.hpp"
#include "paper/device.hpp"
#include "paper/options.hpp"
#include "paper/outputs.hpp"
#include "paper/painter.hpp"
#include "program/arguments.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::paper {
namespace {

struct Options {
    CommonOptions common;
    std::vector<std::string> meshes;
    std::string device;
    std::string count = "5000", least = "0.25";
    PanelSize size;
};

/// From `least` at one end of the longest side of the mesh's box to 1 at the other, each step by
/// the same factor.
RadiusField ramp(const PaperMesh& mesh, double least) {
    const std::size_t dimension = mesh.file.dimension;
    const std::vector<double>& positions = mesh.file.positions;
    std::size_t longest = 0;
    double low = 0, extent = 0;
    for (std::size_t axis = 0; axis < dimension; ++axis) {
        double min_at = std::numeric_limits<double>::infinity(), max_at = -min_at;
        for (std::size_t i = axis; i < positions.size(); i += dimension) {
            min_at = std::min(min_at, positions[i]);
            max_at = std::max(max_at, positions[i]);
        }
        if (max_at - min_at > extent) {
            longest = axis;
            low = min_at;
            extent = max_at - min_at;
        }
    }
    std::vector<double> factors;
    for (std::size_t i = longest; i < positions.size(); i += dimension) {
        factors.push_back(std::pow(least, (positions[i] - low) / extent));
    }
    return tools::take(RadiusField::prepare(mesh.prepared, factors), mesh.name);
}

void run(const Options& options) {
    Outputs outputs(options.common.out, "fig11", /* has_plots */ false);
    const double count = tools::parse_count("--count", options.count);
    const double least = tools::parse_ratio("--least", options.least, RadiusField::kMinFactor, 1);
    PictureParams panel = square_panel(options.size);
    const std::vector<PaperMesh> meshes = load_meshes(options.meshes);
    Device device(options.device, /* graphics */ true);
    const Painter painter(device.context());
    Table table({"mesh", "largest radius", "smallest radius", "samples"});
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const PaperMesh& mesh = meshes[i];
        const RadiusField radii = ramp(mesh, least);
        SampleParams params{distance_for_count(radii.effective_area(), count), options.common.seed,
                            kDefaultPoolRatio};
        params.radii = &radii;
        const SampleSet set = device.sample(mesh, params);
        std::vector<tools::SurfaceDisk> disks = disks_of(places_of(set), params.min_distance);
        for (std::size_t k = 0; k < disks.size(); ++k) {
            disks[k].radius *= radii.factor_at(disks[k].face, set.samples[k].weights);
        }
        const auto [smallest, largest] =
            std::minmax_element(disks.begin(), disks.end(),
                                [](const auto& a, const auto& b) { return a.radius < b.radius; });
        table.add({mesh.name, tools::rounded(largest->radius, 6),
                   tools::rounded(smallest->radius, 6), std::to_string(set.samples.size())});
        std::vector<Pixels> panels;
        for (const auto style : {tools::picture::Style::density, tools::picture::Style::disks}) {
            panel.style = style;
            panels.push_back(painter.surface(mesh, disks, panel));
        }
        outputs.add_picture(numbered(i, meshes.size()), side_by_side(panels));
    }
    outputs.add_table(table,
                      {"device " + device.name(), "seed " + std::to_string(options.common.seed),
                       "count " + options.count + ", least " + options.least},
                      "Radii that vary along a mesh: how dense samples are, and their disks",
                      "Radii go from the largest to --least of it along the longest side of the"
                      "\nbounding box. To the left samples per length, blue to yellow, as measured"
                      "\nfrom the set. The paper: a function given by the user, and the samples.");
    outputs.write();
}

} // namespace

void add_fig11(tools::Command app) {
    add_figure<Options>(
        app, "fig11", "Fig. 11: pictures of samples whose radii vary, on a device", 1, run,
        [](tools::Command command, Options& options) {
            add_meshes(command, options.meshes);
            command.add_option("-n,--count", options.count, "N", "Approximate number of samples")
                .shows_default();
            command
                .add_option("--least", options.least, "G",
                            "Smallest radius over the largest, 0.001 to 1")
                .shows_default();
            add_panel_size(command, options.size);
            add_device(command, options.device);
        });
}

} // namespace geodisk::paper
