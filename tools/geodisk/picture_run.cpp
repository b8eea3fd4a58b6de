#include "geodisk/picture_run.hpp"

#include <sstream>
#include <utility>

#include <geodisk/version.hpp>

#include "files/input_file.hpp"
#include "geodisk/opened_device.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "picture/png.hpp"
#include "picture/surface_content.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

/// Tells what was drawn.
class RenderReport {
  public:
    RenderReport(const RenderOptions& options, const PictureSubject& subject,
                 const DrawnPicture& drawn)
        : options_(options), subject_(subject), drawn_(drawn) {}

    std::string json(double write_seconds) const {
        Json views = Json::array();
        for (const picture::View& view : drawn_.picture.views) {
            views.push_back({{"azimuth", view.azimuth}, {"elevation", view.elevation}});
        }
        Json document{{"version", GEODISK_VERSION_STRING}};
        document.update(subject_.json);
        document.update({{"samples_file", subject_.samples_file},
                         {"samples", drawn_.samples},
                         {"output", options_.out.output},
                         {"width", drawn_.picture.pixels.width},
                         {"height", drawn_.picture.pixels.height},
                         {"style", picture::to_string(drawn_.picture.style)},
                         {"up", up_name()},
                         {"views", views},
                         {"windows", drawn_.windows},
                         {"device", drawn_.device},
                         {"seconds",
                          {{"windows", drawn_.window_seconds},
                           {"draw", drawn_.draw_seconds},
                           {"write", write_seconds}}}});
        return text_of(document);
    }

    std::string summary(double write_seconds) const {
        std::ostringstream out;
        out << subject_.lines << "samples       " << grouped(drawn_.samples) << " in "
            << one_line(subject_.samples_file) << '\n'
            << "picture       " << picture::to_string(drawn_.picture.style) << ", "
            << drawn_.picture.pixels.width << " x " << drawn_.picture.pixels.height << '\n';
        for (const picture::View& view : drawn_.picture.views) {
            out << "view          " << rounded(view.azimuth, 4) << ',' << rounded(view.elevation, 4)
                << ", " << up_name() << " up\n";
        }
        out << "time          " << seconds_text(drawn_.window_seconds) << " disks, "
            << seconds_text(drawn_.draw_seconds) << " drawing, " << seconds_text(write_seconds)
            << " writing\n"
            << "device        " << drawn_.device << '\n'
            << "file          " << one_line(options_.out.output) << '\n';
        return out.str();
    }

  private:
    std::string up_name() const { return {small_letter(drawn_.picture.up)}; }

    const RenderOptions& options_;
    const PictureSubject& subject_;
    const DrawnPicture& drawn_;
};

/// Shows how far the work is, and ends it on a signal.
PartDone show_progress(ProgressLine& progress) {
    return [&progress](double part) {
        check_interrupted();
        progress.update(part, "");
    };
}

} // namespace

DrawnPicture draw_content(const Context& context, const picture::PictureParams& params,
                          const picture::Content& content, ProgressLine& progress) {
    progress.begin_stage("drawing");
    DrawnPicture drawn;
    drawn.samples = content.samples.size() + content.balls.size();
    drawn.windows = content.table.windows.size();
    const Stopwatch watch;
    const picture::Gpu gpu(context.device(), context.queue());
    drawn.picture = picture::draw_picture(gpu, content, params, show_progress(progress));
    drawn.draw_seconds = watch.seconds();
    drawn.device = context.report().name;
    check_validation(context);
    return drawn;
}

void write_picture(const RenderOptions& options, const PictureSubject& subject,
                   const DrawnPicture& drawn, ProgressLine& progress) {
    const RenderReport report(options, subject, drawn);
    write_outputs(options.out, "the picture", progress, report,
                  [&](AtomicFile& file) { picture::write_png(file, drawn.picture.pixels); });
}

void check_picture_path(const Path& path) {
    if (lower_extension(path) != ".png" && !output_stream(path)) {
        fail_usage(path.string() + ": pictures are written as *.png");
    }
    check_writable(path);
}

void check_visible(const MeshInput& mesh) {
    if (mesh.dimension() == 0) {
        fail_input(mesh.path, "has edge lengths but no coordinates, so it cannot be drawn");
    }
}

picture::Scene make_scene(const MeshOptions& options, const MeshInput& mesh) {
    picture::Scene scene =
        picture::make_scene(mesh.file.positions, mesh.dimension(), mesh.file.triangles);
    if (!options.lifts.empty() || !mesh.file.lengths.empty()) {
        scene.scale = 0; // Lengths on the surface are others than those in space.
    }
    return scene;
}

DrawnPicture draw_surface(const Context& context, const picture::PictureParams& params,
                          const PreparedMesh& mesh, const picture::Scene& scene,
                          std::vector<SurfaceDisk> disks, ProgressLine& progress) {
    progress.begin_stage("computing the disks");
    const Stopwatch watch;
    const picture::SurfaceContent content = picture::make_surface_content(
        mesh, std::move(disks), params.style, show_progress(progress));
    const double window_seconds = watch.seconds();
    DrawnPicture drawn =
        draw_content(context, params, {scene, content.table, content.samples}, progress);
    drawn.window_seconds = window_seconds;
    return drawn;
}

} // namespace geodisk::tools
