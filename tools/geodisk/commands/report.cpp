#include <memory>
#include <span>
#include <string>
#include <vector>

#include "files/input_file.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/render_options.hpp"
#include "geodisk/options/sample_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/page_report.hpp"
#include "geodisk/reports/sample_report.hpp"
#include "geodisk/sample_run.hpp"
#include "geodisk/set_analysis.hpp"
#include "geodisk/spectrum_run.hpp"
#include "picture/view.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/program.hpp"
#include "program/stopwatch.hpp"
#include "report/page.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kReportExamples[] = {
    "geodisk report bunny.obj -o bunny.html --count 1000",
    "geodisk report bunny.obj -o bunny.html --min-distance 2% --view front",
};

/// As given on the command line.
struct ReportOptions {
    SampleOptions sample; ///< Its output is the page.
    std::string probes, view = "auto";
    UpOption up;
    std::string harmonics; ///< Harmonics of the spectrum; "" for none.

    /// The views to choose the first one from. Throws UserError(usage).
    std::vector<picture::View> first_views() const {
        const auto given = picture::parse_view("--view", view);
        return given ? std::vector{*given} : picture::views_to_try();
    }
};

/// Adds all options of the command; `options` must outlive the parsing.
void add_report_options(Command command, ReportOptions& options) {
    add_mesh_argument(command, options.sample.mesh, "Mesh to sample");
    add_output_argument(command, options.sample.out, "Page to write: *.html");
    command
        .add_option("--view", options.view, "VIEW",
                    "First direction of view: front, back, left, right, top,\n"
                    "bottom, AZIMUTH,ELEVATION in degrees, or auto for the one\n"
                    "that shows most")
        .offers(picture::named_views())
        .shows_default();
    add_up_option(command, options.up);
    add_probes_option(command, options.probes);
    command.add_option("--harmonics", options.harmonics, "K",
                       "Show the power spectrum from K waves of the surface (default\n"
                       "no spectrum); blue noise needs about five per sample");
    add_job_options(command, options.sample);
    add_json_option(command, options.sample.out);
    add_quiet_option(command, options.sample.out);
    add_verbose_option(command, options.sample.run.device);
}

void check_page_path(const Path& path) {
    const std::string extension = lower_extension(path);
    if (extension != ".html" && extension != ".htm" && !output_stream(path)) {
        fail_usage(path.string() + ": reports are written as *.html");
    }
    check_writable(path);
}

SpectrumRun spectrum_of(const MeshInput& mesh, std::span<const SurfaceDisk> disks,
                        const std::string& harmonics, ProgressLine& progress) {
    analysis::PlacedSamples places;
    for (const SurfaceDisk& disk : disks) {
        places.push_back({disk.face, disk.weight1, disk.weight2});
    }
    std::vector<MeshWarning> warnings; // Printed; the page tells of the mesh itself.
    return compute_spectrum_on(mesh, std::span(&places, 1), harmonics, warnings, progress);
}

void run_report(const ReportOptions& options) {
    const Stopwatch all;
    report::require_front_end();
    const SampleJob job = parse_job(options.sample);
    PageResult page;
    page.views = options.first_views();
    page.command = given_command();
    const auto up = options.up.parsed();
    probes_for(options.probes, 1); // Before the files are read.
    parse_harmonics(options.harmonics);
    check_outputs(job.out, "the page", files_read(job), check_page_path);

    ProgressLine progress(job.out.quiet);
    const MeshInput mesh = load_mesh(job.mesh, progress, job.density, job.mask, "");
    if (!options.harmonics.empty() && mesh.radii) {
        fail_usage("--harmonics: a spectrum is of samples whose radii do not vary");
    }
    const SampleResult result = [&] {
        RunDevice device = device_for(job);
        return sample_mesh(job, mesh, device, progress);
    }();
    print_warnings(result.warnings);
    const SampleDisks samples =
        disks_of(result.rows, job.classes, result.classes, result.params.min_distance);
    Stopwatch watch;
    page.set = analyze_disks(mesh, samples, options.probes, 0, progress);
    page.measure_seconds = watch.seconds();
    if (!options.harmonics.empty()) {
        page.spectrum = spectrum_of(mesh, samples.disks, options.harmonics, progress);
    }
    watch = Stopwatch();
    page.content = make_page_content(mesh, samples, page.set.found.neighbors, up, progress);
    page.disk_seconds = watch.seconds();
    page.all_seconds = all.seconds();

    const SampleReport report(job, mesh, result);
    const PageReport told(report, page);
    write_outputs(job.out, "the page", progress, told, [&](AtomicFile& file) {
        report::write_page(file, {told.facts(), page.content.arrays});
    });
}

} // namespace

void add_report_command(Command app) {
    const Command command = app.add_command(
        "report", "Sample a mesh and write a page that shows and measures the samples");
    const auto options = std::make_shared<ReportOptions>();
    add_report_options(command, *options);
    command.has_footer(help_footer(kReportExamples));
    command.calls([options] { run_report(*options); });
}

} // namespace geodisk::tools
