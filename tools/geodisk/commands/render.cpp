#include <algorithm>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/version.hpp>

#include "files/input_file.hpp"
#include "files/sample_file.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/opened_device.hpp"
#include "geodisk/inputs/box_input.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/render_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/box_report.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "picture/flat_box.hpp"
#include "picture/picture.hpp"
#include "picture/png.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/program.hpp"

namespace geodisk::tools {
namespace {

using picture::Picture;
using picture::PictureParams;

/// What a picture is of: a surface, and a disk for each sample, of its radius.
struct Subject {
    std::string lines; ///< For people.
    Json json;         ///< For programs.
    std::vector<picture::DiskSource> disks;
    double spacing = 0; ///< Twice the median radius.
};

/// What was drawn, and how long that took.
struct Drawn {
    Picture picture;
    std::size_t samples = 0;
    std::size_t windows = 0;
    std::string device;
    double window_seconds = 0, draw_seconds = 0;
};

void check_picture_path(const Path& path) {
    if (lower_extension(path) != ".png") {
        fail_usage(path.string() + ": pictures are written as *.png");
    }
    check_writable(path);
}

/// Makes the disks reach as far as the style looks.
void finish_subject(Subject& subject, const std::string& samples, picture::Style style) {
    if (subject.disks.empty()) {
        fail_input(samples, "has no samples to show");
    }
    std::vector<double> radii;
    for (const picture::DiskSource& disk : subject.disks) {
        radii.push_back(disk.reach);
    }
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    subject.spacing = 2 * *middle;
    for (picture::DiskSource& disk : subject.disks) {
        disk.reach *= picture::reach_of(style);
    }
}

Drawn draw(const RenderOptions& options, const PictureParams& params, const PreparedMesh& mesh,
           const picture::Scene& scene, const Subject& subject, ProgressLine& progress) {
    const auto tell = [&](double part) {
        check_interrupted();
        progress.update(part, "");
    };
    Drawn drawn;
    drawn.samples = subject.disks.size();
    progress.begin_stage("computing the disks");
    Stopwatch watch;
    const picture::WindowTable table =
        picture::make_window_table(mesh, subject.disks, subject.spacing, tell);
    drawn.windows = table.windows.size();
    drawn.window_seconds = watch.seconds();

    std::vector<picture::DrawnSample> samples;
    for (const picture::DiskSource& disk : subject.disks) {
        const double radius = disk.reach / picture::reach_of(params.style) / table.unit;
        // Neighbours in a file are of any colour.
        const auto number = static_cast<std::uint32_t>(samples.size());
        samples.push_back({static_cast<float>(radius), number * 2654435761u >> 8});
    }
    const Context context = open_device(options.device, true, progress);
    drawn.device = context.report().name;
    progress.begin_stage("drawing");
    watch = Stopwatch();
    {
        const picture::Gpu gpu(context.device(), context.queue());
        drawn.picture = picture::draw_picture(gpu, scene, table, samples, params, tell);
    }
    drawn.draw_seconds = watch.seconds();
    check_validation(context);
    return drawn;
}

/// Tells what was drawn.
class RenderReport {
  public:
    RenderReport(const RenderOptions& options, const Subject& subject, const Drawn& drawn)
        : options_(options), subject_(subject), drawn_(drawn) {}

    std::string json(double write_seconds) const {
        Json views = Json::array();
        for (const picture::View& view : drawn_.picture.views) {
            views.push_back({{"azimuth", view.azimuth}, {"elevation", view.elevation}});
        }
        Json document{{"version", GEODISK_VERSION_STRING}};
        document.update(subject_.json);
        document.update({{"samples_file", samples_file()},
                         {"samples", drawn_.samples},
                         {"output", options_.out.output},
                         {"width", drawn_.picture.pixels.width},
                         {"height", drawn_.picture.pixels.height},
                         {"style", options_.style},
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
            << one_line(samples_file()) << '\n'
            << "picture       " << options_.style << ", " << drawn_.picture.pixels.width << " x "
            << drawn_.picture.pixels.height << '\n';
        for (const picture::View& view : drawn_.picture.views) {
            out << "view          " << rounded(view.azimuth, 4) << ','
                << rounded(view.elevation, 4) << ", " << up_name() << " up\n";
        }
        out << "time          " << seconds_text(drawn_.window_seconds) << " disks, "
            << seconds_text(drawn_.draw_seconds) << " drawing, " << seconds_text(write_seconds)
            << " writing\n"
            << "device        " << drawn_.device << '\n'
            << "file          " << one_line(options_.out.output) << '\n';
        return out.str();
    }

  private:
    const std::string& samples_file() const {
        return options_.samples.empty() ? options_.mesh.mesh : options_.samples;
    }
    const char* up_name() const {
        return drawn_.picture.up == picture::Up::x   ? "x"
               : drawn_.picture.up == picture::Up::y ? "y"
                                                     : "z";
    }

    const RenderOptions& options_;
    const Subject& subject_;
    const Drawn& drawn_;
};

void write_picture(const RenderOptions& options, const Subject& subject, const Drawn& drawn,
                   ProgressLine& progress) {
    const RenderReport report(options, subject, drawn);
    write_outputs(options.out, "the picture", progress, report,
                  [&](AtomicFile& file) { picture::write_png(file, drawn.picture.pixels); });
}

void render_box(const RenderOptions& options, PictureParams params) {
    const std::string& path = options.mesh.mesh;
    const std::string extension = lower_extension(path);
    if (extension != ".ply" && extension != ".csv") {
        fail_usage("SAMPLES is required, except for samples in a box, *.ply or *.csv, which are "
                   "shown without a mesh");
    }
    if (!options.mesh.additions().empty()) {
        fail_usage("options of surfaces need MESH and SAMPLES; a single file is one of samples in "
                   "a box");
    }
    check_outputs(options.out, "the picture", {{"the samples", path}}, check_picture_path);
    ProgressLine progress(options.out.quiet);
    progress.begin_stage("reading the samples");
    const SampleFile samples = read_box_samples(path);
    const std::optional<Length> distance = parse_distance(options);
    BoxParams box = box_of(path, distance ? "1" : "", samples);
    if (distance) {
        box.min_distance = distance->in_mesh_units(diagonal_of(box));
    }
    if (box.extents.size() != 2) {
        fail_input(path, "its box has " + counted(box.extents.size(), "dimension", "dimensions") +
                             "; pictures are of those with 2");
    }
    Subject subject;
    subject.lines = "box           " + box_text(box) + '\n';
    subject.json = {{"box", {{"extents", box.extents}, {"periodic", box.is_periodic}}}};
    const picture::FlatBox flat(box);
    for (const SampleRow& row : samples.rows) {
        subject.disks.push_back(
            flat.disk(row.position[0], row.position[1], box.min_distance / 2));
    }
    finish_subject(subject, path, params.style);
    if (options.views.empty()) {
        params.views = {picture::View{0, 0}};
    }
    params.up = params.up.value_or(picture::Up::y);
    const picture::Scene scene = picture::make_scene(flat.positions(), 2, flat.triangles());
    write_picture(options, subject, draw(options, params, flat.mesh(), scene, subject, progress),
                  progress);
}

void render_surface(const RenderOptions& options, const PictureParams& params) {
    std::vector<NamedFile> read{{"the samples", options.samples}};
    options.mesh.add_files(read, "the mesh");
    check_outputs(options.out, "the picture", read, check_picture_path);
    const std::optional<Length> distance = parse_distance(options);
    ProgressLine progress(options.out.quiet);
    const MeshInput mesh = load_mesh(options.mesh, progress);
    if (mesh.dimension() == 0) {
        fail_input(options.mesh.mesh,
                   "has edge lengths without coordinates, so there is nothing to look at");
    }
    progress.begin_stage("reading the samples");
    const SampleFile samples = read_samples(options.samples);
    check_on_mesh(options.samples, samples, options.mesh.mesh, mesh);
    progress.clear();

    Subject subject;
    subject.lines =
        mesh_lines("mesh", options.mesh.mesh, options.mesh.additions(), mesh);
    subject.json = {{"mesh", mesh_json(options.mesh.mesh, options.mesh.additions(), mesh)},
                    {"warnings", warnings_json(mesh.warnings)}};
    const bool has_own = has_radii(samples.rows) && !distance;
    const double radius =
        has_own || samples.rows.empty() ? 0
        : distance ? distance_on_mesh(*distance, mesh.prepared.statistics()) / 2
                   : header_distance(options.samples, samples.header) / 2;
    for (const SampleRow& row : samples.rows) {
        subject.disks.push_back({row.face, static_cast<double>(row.bary[1]),
                                 static_cast<double>(row.bary[2]), has_own ? row.radius : radius});
    }
    finish_subject(subject, options.samples, params.style);
    progress.begin_stage("preparing the scene");
    const picture::Scene scene =
        picture::make_scene(mesh.file.positions, mesh.dimension(), mesh.file.triangles);
    write_picture(options, subject, draw(options, params, mesh.prepared, scene, subject, progress),
                  progress);
}

void run_render(const RenderOptions& options) {
    const PictureParams params = parse_picture(options);
    if (options.samples.empty()) {
        render_box(options, params);
    } else {
        render_surface(options, params);
    }
}

} // namespace

void add_render_command(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("render", "Draw samples and their geodesic disks as a picture");
    const auto options = std::make_shared<RenderOptions>();
    add_render_options(*command, *options);
    command->callback([options] { run_render(*options); });
}

} // namespace geodisk::tools
