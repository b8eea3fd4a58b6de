#include <memory>
#include <utility>
#include <vector>

#include "files/samples/sample_file.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/opened_device.hpp"
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

/// Returns the picture that options ask for, of samples on a mesh.
picture::PictureParams surface_picture(const RenderOptions& options) {
    picture::PictureParams params = parse_picture(options);
    if (params.cuts) {
        fail_usage("--cut is for samples in a box of 3 dimensions");
    }
    return params;
}

void render_samples(const RenderOptions& options) {
    static_cast<void>(surface_picture(options)); // Fails before reading anything.
    std::vector<NamedFile> read{{"the samples", options.samples}};
    options.mesh.add_files(read, "the mesh");
    check_outputs(options.out, "the picture", read, check_picture_path);
    static_cast<void>(options.distance.parsed());
    check_tolerance(options.tolerance);
    ProgressLine progress(options.out.quiet);
    const MeshInput mesh = load_mesh(options.mesh, progress);
    check_visible(mesh);
    std::vector<MeshWarning> warnings = mesh.warnings;
    const SampleFile samples =
        read_samples_exactly_on(options.samples, mesh, options.tolerance, warnings, progress);
    std::vector<MeshWarning> of_disks;
    const DrawnPicture drawn = draw_samples(
        options, mesh, samples, of_disks,
        [&] { return open_device(options.device, true, progress); }, progress);
    print_warnings(of_disks);
    warnings.insert(warnings.end(), of_disks.begin(), of_disks.end());
    const PictureSubject subject{
        options.samples,
        mesh_lines("mesh", mesh),
        {{"mesh", mesh_json(mesh)}, {"warnings", warnings_json(warnings)}}};
    write_picture(options, subject, drawn, progress);
}

} // namespace

DrawnPicture draw_samples(const RenderOptions& options, const MeshInput& mesh,
                          const SampleFile& samples, std::vector<MeshWarning>& warnings,
                          const OpenContext& open, ProgressLine& progress) {
    const picture::PictureParams params = surface_picture(options);
    check_visible(mesh);
    std::vector<SurfaceDisk> disks =
        sample_disks_silently(samples, mesh, options.distance.parsed(), warnings, progress).disks;
    if (disks.empty()) {
        fail_input(options.samples, "has no samples to show");
    }
    progress.begin_stage("preparing the scene");
    const picture::Scene scene = make_scene(options.mesh, mesh);
    return draw_surface(open(), params, mesh.prepared, scene, std::move(disks), progress);
}

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
