#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "files/samples/sample_file.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/render_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/picture_run.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "geodisk/reports/picture_subject.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kRenderExamples[] = {
    "geodisk render bunny.obj points.ply -o picture.png",
    "geodisk render bunny.obj points.ply -o cells.png --style voronoi --view front --view back",
    "geodisk render bunny.obj points.ply -o density.png --style density --legend",
    "geodisk render box.csv -o box.png",
};

void render_samples(const RenderOptions& options) {
    const picture::PictureParams params = parse_picture(options);
    if (params.cuts) {
        fail_usage("--cut is for samples in a box of 3 dimensions");
    }
    std::vector<NamedFile> read{{"the samples", options.samples}};
    options.mesh.add_files(read, "the mesh");
    check_outputs(options.out, "the picture", read, check_picture_path);
    const std::optional<Length> distance = options.distance.parsed();
    check_tolerance(options.tolerance);
    ProgressLine progress(options.out.quiet);
    const MeshInput mesh = load_mesh(options.mesh, progress);
    check_visible(options.mesh.mesh, mesh);
    std::vector<MeshWarning> warnings = mesh.warnings;
    const HeaderEntries additions = options.mesh.additions();
    const SampleFile samples =
        read_samples_exactly_on(options.samples, options.mesh.mesh, mesh, &additions,
                                options.tolerance, warnings, progress);
    std::vector<SurfaceDisk> disks =
        sample_disks(options.samples, samples, mesh, distance, warnings, progress).disks;
    const PictureSubject subject{
        options.samples,
        mesh_lines("mesh", options.mesh.mesh, options.mesh.additions(), mesh),
        {{"mesh", mesh_json(options.mesh.mesh, options.mesh.additions(), mesh)},
         {"warnings", warnings_json(warnings)}}};
    progress.begin_stage("preparing the scene");
    const picture::Scene scene = make_scene(options.mesh, mesh);
    render_surface(options, params, subject, mesh.prepared, scene, std::move(disks), progress);
}

} // namespace

void add_render_command(Command app) {
    const Command command =
        app.add_command("render", "Draw samples and their geodesic disks as a picture");
    const auto options = std::make_shared<RenderOptions>();
    add_render_options(command, *options);
    command.has_footer(help_footer(kRenderExamples));
    command.calls([options] {
        if (options->samples.empty()) {
            render_box(*options);
        } else {
            render_samples(*options);
        }
    });
}

} // namespace geodisk::tools
