// Fig. 10: surfaces of four dimensions, and samples that a surface has in another pose (section
// 5.8).
#include <utility>

#include "paper/commands.hpp"
#include "paper/device.hpp"
#include "paper/metrics.hpp"
#include "paper/options.hpp"
#include "paper/outputs.hpp"
#include "paper/painter.hpp"
#include "program/arguments.hpp"
#include "program/human_text.hpp"

namespace geodisk::paper {
namespace {

struct Options {
    CommonOptions common;
    std::string device;
    std::string count = "2000";
    PanelSize size;
};

constexpr const char* kSurfaces[] = {"builtin:clifford-torus:96", "builtin:klein-bottle:72"};
/// A pose, and another of the same faces and lengths.
constexpr std::pair<const char*, const char*> kPoses{"builtin:swiss-roll:96",
                                                     "builtin:unrolled-sheet:96"};

void run(const Options& options) {
    Outputs outputs(options.common.out, "fig10", /* has_plots */ false);
    const double count = tools::parse_count("--count", options.count);
    const PictureParams panel = square_panel(options.size);
    Device device(options.device, /* graphics */ true);
    const Painter painter(device.context());
    Table table({"surface", "coordinates", "samples of", "samples", "pairs too close"});
    std::vector<Pixels> panels;
    const auto show = [&](const PaperMesh& mesh, const PaperMesh& sampled, const SampleSet& set,
                          double min_distance) {
        table.add({mesh.name, std::to_string(mesh.file.dimension), sampled.name,
                   std::to_string(set.samples.size()),
                   std::to_string(find_violations(mesh, places_of(set), min_distance).pairs)});
        panels.push_back(painter.surface(mesh, disks_of(places_of(set), min_distance), panel));
    };
    for (const char* const name : kSurfaces) {
        const PaperMesh mesh = load_mesh(name);
        const SampleParams params = params_for(mesh, count, kDefaultPoolRatio, options.common.seed);
        show(mesh, mesh, device.sample(mesh, params), params.min_distance);
    }
    const PaperMesh pose = load_mesh(kPoses.first), other = load_mesh(kPoses.second);
    const SampleParams params = params_for(pose, count, kDefaultPoolRatio, options.common.seed);
    const SampleSet set = device.sample(pose, params);
    show(pose, pose, set, params.min_distance);
    show(other, pose, set, params.min_distance);
    outputs.add_table(table,
                      {"device " + device.name(), "seed " + std::to_string(options.common.seed)},
                      "Surfaces in R^4, and samples of one pose taken to another of the same faces",
                      "Surfaces of four dimensions are shown in perspective, as by stereographic"
                      "\nprojection; their distances are those of R^4. The paper: the method knows"
                      "\nlengths along the surface alone, so samples of a pose are valid in another"
                      "\nthat is isometric.");
    outputs.add_picture("", side_by_side(panels));
    outputs.write();
}

} // namespace

void add_fig10(tools::Command app) {
    add_figure<Options>(
        app, "fig10", "Fig. 10: pictures of surfaces in R^4 and of another pose, on a device", 1,
        run, [](tools::Command command, Options& options) {
            command.add_option("-n,--count", options.count, "N", "Samples of each surface")
                .shows_default();
            add_panel_size(command, options.size);
            add_device(command, options.device);
        });
}

} // namespace geodisk::paper
