#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/input_file.hpp"
#include "files/samples/sample_file.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/inputs/box_input.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/opened_device.hpp"
#include "geodisk/options/box_options.hpp"
#include "geodisk/options/render_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/picture_run.hpp"
#include "geodisk/reports/box_report.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "picture/box_frame.hpp"
#include "picture/flat_box.hpp"
#include "picture/surface_content.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kRenderExamples[] = {
    "geodisk render bunny.obj points.ply -o picture.png",
    "geodisk render bunny.obj points.ply -o cells.png --style voronoi --view front --view back",
    "geodisk render bunny.obj points.ply -o density.png --style density --legend",
    "geodisk render box.csv -o box.png",
};

using picture::PictureParams;
using picture::Style;

/// Returns the picture that options ask for, of samples on a mesh.
PictureParams surface_picture(const RenderOptions& options) {
    PictureParams params = parse_picture(options);
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

/// Radius of points drawn in space, as a part of the disk's radius.
constexpr double kPointPart = 0.3;

/// A single file must be one of samples in a box, which has nothing of a surface.
void check_options(const RenderOptions& options) {
    const std::string extension = lower_extension(options.mesh.mesh);
    if (extension != ".ply" && extension != ".csv" && options.mesh.mesh != "-") {
        fail_usage("SAMPLES is required, except for samples in a box (*.ply or *.csv), which need "
                   "no mesh");
    }
    if (!options.mesh.additions().empty()) {
        fail_usage(
            "options for surfaces need MESH and SAMPLES; a single file must hold samples in a box");
    }
    check_outputs(options.out, "the picture", {{"the samples", options.mesh.mesh}},
                  check_picture_path);
}

DrawnPicture draw_flat(const PictureParams& params, const BoxParams& box, const SampleFile& samples,
                       const OpenContext& open, ProgressLine& progress) {
    const picture::FlatBox flat(box);
    std::vector<SurfaceDisk> disks;
    for (const SampleRow& row : samples.rows) {
        disks.push_back(flat.disk(row.position[0], row.position[1], box.min_distance / 2));
    }
    const picture::Scene scene = picture::make_scene(flat.positions(), 2, flat.triangles());
    return draw_surface(open(), params, flat.mesh(), scene, std::move(disks), progress);
}

DrawnPicture draw_balls(const PictureParams& params, const BoxParams& box,
                        const SampleFile& samples, const OpenContext& open,
                        ProgressLine& progress) {
    if (params.style != Style::automatic && params.style != Style::disks &&
        params.style != Style::points) {
        fail_usage("--style " + std::string(picture::to_string(params.style)) +
                   " is for surfaces; samples in a box of 3 dimensions take --style disks (balls) "
                   "or points");
    }
    const double radius = box.min_distance / 2 * (params.style == Style::points ? kPointPart : 1);
    const picture::BoxFrame frame(box, radius);
    std::vector<picture::BallRec> balls;
    for (const SampleRow& row : samples.rows) {
        const std::array<double, 3> at{row.position[0], row.position[1], row.position[2]};
        balls.push_back(frame.ball(at, radius, picture::color_of(balls.size())));
    }
    return draw_content(open(), params, {frame.scene(), frame.table(), {}, balls, box.min_distance},
                        progress);
}

/// Draws samples in a box of two or three dimensions.
void render_box(const RenderOptions& options) {
    static_cast<void>(parse_picture(options)); // Fails before reading anything.
    check_options(options);
    ProgressLine progress(options.out.quiet);
    progress.begin_stage("reading the samples");
    const std::string& path = options.mesh.mesh;
    const SampleFile samples = read_box_samples(path);
    const BoxParams box = box_to_draw(options, samples);
    const PictureSubject subject{
        path,
        "box           " + box_text(box) + '\n',
        {{"box", {{"extents", box.extents}, {"periodic", box.is_periodic}}}}};
    const DrawnPicture drawn = draw_box(
        options, box, samples, [&] { return open_device(options.device, true, progress); },
        progress);
    write_picture(options, subject, drawn, progress);
}

} // namespace

DrawnPicture draw_samples(const RenderOptions& options, const MeshInput& mesh,
                          const SampleFile& samples, std::vector<MeshWarning>& warnings,
                          const OpenContext& open, ProgressLine& progress) {
    const PictureParams params = surface_picture(options);
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

BoxParams box_to_draw(const RenderOptions& options, const SampleFile& samples) {
    const std::optional<Length> distance = options.distance.parsed();
    BoxParams box = box_of(distance ? "1" : "", samples);
    if (distance) {
        box.min_distance = distance->in_mesh_units(diagonal_of(box));
    }
    if (box.extents.size() != 2 && box.extents.size() != 3) {
        fail_input(samples.path, "its box has " +
                                     counted(box.extents.size(), "dimension", "dimensions") +
                                     "; a picture needs 2 or 3");
    }
    return box;
}

DrawnPicture draw_box(const RenderOptions& options, const BoxParams& box, const SampleFile& samples,
                      const OpenContext& open, ProgressLine& progress) {
    PictureParams params = parse_picture(options);
    const bool is_flat = box.extents.size() == 2;
    if (is_flat && params.cuts) {
        fail_usage("--cut is for samples in a box of 3 dimensions");
    }
    if (samples.rows.empty()) {
        fail_input(samples.path, "has no samples to show");
    }
    params.up = params.up.value_or(picture::Up::y);
    for (std::optional<picture::View>& view : params.views) {
        view = view.value_or(is_flat ? picture::View{0, 0} : picture::View{30, 20});
    }
    return is_flat ? draw_flat(params, box, samples, open, progress)
                   : draw_balls(params, box, samples, open, progress);
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
