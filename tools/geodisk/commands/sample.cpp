#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "files/meshes/mesh_file.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/opened_device.hpp"
#include "geodisk/options/sample_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/picture_run.hpp"
#include "geodisk/reports/sample_report.hpp"
#include "geodisk/sample_run.hpp"
#include "picture/png.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/path.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kSampleExamples[] = {
    "geodisk sample bunny.obj -o points.ply --count 10000",
    "geodisk sample bunny.obj -o points.csv --min-distance 1% --seed 7",
    "geodisk sample bunny.obj -o points.ply --min-distance 1% --method darts --count 500",
    "geodisk sample builtin:showpiece -o points.ply --count 10000 --picture points.png",
};

/// On the device that they were made on.
void draw_samples(const SampleJob& job, const MeshInput& mesh, SampleResult& result,
                  RunDevice& device, ProgressLine& progress) {
    device.release_memory();
    progress.begin_stage("preparing the scene");
    const picture::Scene scene = make_scene(job.mesh, mesh);
    picture::PictureParams params;
    params.legend = job.legend;
    if (!job.out.up.empty()) {
        params.up = picture::parse_up("--up", job.out.up);
    }
    result.picture = draw_surface(
        device.context(), params, mesh.prepared, scene,
        disks_of(result.rows, job.classes, result.classes, result.params.min_distance).disks,
        progress);
    check_validation(device.context());
}

// Smaller files are read sooner than it is worth to compile for a surface that may need other
// kernels.
constexpr std::uintmax_t kLargeFile = std::uintmax_t{1} << 18;

/// Begins to open the device, unless there is no mesh to be read meanwhile.
RunDevice begin_device_for(const SampleJob& job) {
    RunDevice device = device_for(job);
    const std::string& mesh = job.mesh.mesh;
    std::error_code error;
    const bool is_file = std::filesystem::is_regular_file(Path(mesh), error);
    if (is_file || is_builtin(mesh)) {
        const bool is_usual =
            job.is_geodesic() && !job.classes.is_given() && job.constraints.avoid.empty();
        const bool is_large =
            is_file && std::filesystem::file_size(Path(mesh), error) >= kLargeFile;
        device.begin_open(!is_usual || !is_large   ? Ahead::nothing
                          : job.density.is_given() ? Ahead::varying_radii
                                                   : Ahead::surface);
    }
    return device;
}

/// Leaves the picture out where the device cannot draw and that will do.
RunDevice open_device_for(SampleJob& job, RunDevice device, bool may_lack_picture,
                          ProgressLine& progress) {
    if (!may_lack_picture) {
        return device;
    }
    try {
        device.open(progress);
        return device;
    } catch (const UserError& error) {
        if (error.code() != ExitCode::no_device) {
            throw;
        }
    }
    job.picture.clear();
    return device_for(job);
}

} // namespace

void sample_to_files(const SampleOptions& options, const UnnamedOutputs& unnamed,
                     SurfaceSampler* sampler) {
    check_output_or_dry_run(options.out);
    SampleJob job = parse_job(options);
    check_outputs(job.out, "the samples", files_read(job), nullptr, {{"the picture", job.picture}});
    if (!job.picture.empty()) {
        check_picture_path(job.picture);
    }
    ProgressLine progress(job.out.quiet);
    RunDevice begun = begin_device_for(job);
    const MeshInput mesh = load_mesh(job.mesh, progress, job.density, job.mask, "");
    if (!job.out.output.empty()) {
        check_target(job, mesh);
    }
    if (!job.picture.empty()) {
        check_visible(mesh);
    }
    RunDevice device = open_device_for(job, std::move(begun), unnamed.may_lack_picture, progress);
    device.sample_by(sampler);
    if (job.out.is_dry_run) {
        const DryRun dry = try_sampling(job, mesh, device, progress);
        publish(job.out, dry_sample_json(job, mesh, dry), dry_sample_text(job, mesh, dry));
        return;
    }
    SampleResult result = sample_mesh(job, mesh, device, progress);
    print_warnings(result.warnings);
    if (!job.picture.empty()) {
        draw_samples(job, mesh, result, device, progress);
    }
    progress.clear();
    print_precision_note(job.out, result.rows, mesh.dimension());
    const SampleReport report(job, mesh, result);
    const auto write = [&](AtomicFile& file) {
        write_sample_file(file, job, mesh, result, report);
    };
    const auto write_picture = [&](AtomicFile& file) {
        picture::write_png(file, result.picture->picture.pixels);
    };
    const auto name_files = [&](const std::vector<AtomicFile*>& files) {
        unnamed.name(files, job.out.output, job.picture);
    };
    write_outputs(job.out, "the samples", progress, report, write, {{job.picture, write_picture}},
                  unnamed.name ? NameFiles(name_files) : nullptr);
}

void add_sample_command(Command app) {
    const Command command =
        app.add_command("sample", "Put samples on a mesh and write them to a file");
    const auto options = std::make_shared<SampleOptions>();
    add_mesh_argument(command, options->mesh, "Mesh to sample");
    add_sample_options(command, *options, kNamedByMesh);
    command.has_footer(help_footer(kSampleExamples));
    command.calls([options] { sample_as_named(*options, false); });
}

} // namespace geodisk::tools
