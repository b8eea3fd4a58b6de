#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "files/samples/sample_format.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/device_run.hpp"
#include "geodisk/dry_run.hpp"
#include "geodisk/options/box_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/box_report.hpp"
#include "geometry/set_warnings.hpp"
#include "picture/view.hpp"
#include "program/command.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kBoxExamples[] = {
    "geodisk box -o points.csv --dim 2 --count 1000 --periodic",
    "geodisk box -o points.npz --extents 2,1,1 --min-distance 0.1",
    "geodisk box -o points.csv --dim 4 --count 1e4 --periodic",
};

std::vector<SampleRow> to_rows(const std::vector<double>& points, std::size_t dimension) {
    std::vector<SampleRow> rows(points.size() / dimension);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        std::copy_n(points.begin() + static_cast<std::ptrdiff_t>(i * dimension), dimension,
                    rows[i].position);
    }
    return rows;
}

void run_box(const BoxOptions& options) {
    check_output_or_dry_run(options.out);
    BoxJob job = parse_job(options);
    job.out.check_scene(false);
    const auto dimension = static_cast<std::uint32_t>(job.box.extents.size());
    check_outputs(job.out, "the samples", {});
    if (!job.out.output.empty()) {
        check_box_dimension(job.out.target(), dimension);
    }
    ProgressLine progress(job.out.quiet);
    RunDevice device(job.run.device, job.runner);
    if (job.out.is_dry_run) {
        const DryRun dry = dry_run_on_device(device, job.request(), job.box.seed, progress);
        publish(job.out, dry_box_json(job, dry), dry_box_text(job, dry));
        return;
    }
    const auto [found, done] = device.run(job.request(), progress);
    job.box.min_distance = done.min_distance;
    const std::vector<SampleRow> rows = to_rows(found.set.points, dimension);
    job.method.check_count(rows.size(), job.box.min_distance, done.run.candidates);
    for (const MeshWarning& warning : set_warnings({.samples = rows.size(),
                                      .min_distance = job.box.min_distance,
                                      .wanted_count = job.wanted_count.samples,
                                      .cut = done.cut,
                                      .stop_count = job.method.params.stop_count,
                                      .has_darts = job.method.params.darts > 0,
                                      .domain = "box"})) {
        print_warning(warning.message);
    }
    if (const auto note = rounding_note(job.out.target(), rows, dimension, job.box.min_distance)) {
        print_warning(job.out.output + ": " + *note);
    }
    const BoxReport report(job, rows.size(), done);
    write_outputs(job.out, "the samples", progress, report, [&](AtomicFile& file) {
        SampleTarget target = job.out.target();
        target.up = job.out.up.empty() ? Up::y : picture::parse_up("--up", job.out.up);
        write_box_samples(file, target, report.header(), rows, dimension);
    });
}

} // namespace

void add_box_command(Command app) {
    const Command command =
        app.add_command("box", "Put samples in a box of R^n, by straight-line distance");
    const auto options = std::make_shared<BoxOptions>();
    const auto is_for_viewers = [](const FormatFacts& format) { return !format.is_for_programs; };
    add_output_or_dry_run(
        command, options->out,
        wrapped("File to write: " + listed_formats(&FormatFacts::is_for_programs, "*.") + "; or " +
                listed_formats(is_for_viewers, "*.") +
                " with 0 for coordinates that the box lacks"));
    add_box_options(command, *options);
    add_seed_option(command, options->run);
    add_device_options(command, options->run.device);
    add_limit_options(command, options->run);
    add_output_options(command, options->out);
    add_verbose_option(command, options->run.device);
    command.has_footer(help_footer(kBoxExamples));
    command.calls([options] { run_box(*options); });
}

} // namespace geodisk::tools
