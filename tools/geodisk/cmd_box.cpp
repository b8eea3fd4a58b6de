#include "geodisk/cmd_box.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <geodisk/box.hpp>

#include "common/atomic_file.hpp"
#include "common/text.hpp"
#include "geodisk/box_report.hpp"
#include "geodisk/box_text.hpp"
#include "geodisk/device_run.hpp"
#include "geodisk/outputs.hpp"
#include "geodisk/run_options.hpp"
#include "geodisk/run_outputs.hpp"
#include "program/arguments.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// As given on the command line.
struct BoxOptions {
    std::string dimension, min_distance, count;
    std::vector<std::string> extents;
    std::string output, pool_ratio = "20";
    bool is_periodic = false;
    RunOptions run;
};

/// The options, checked.
struct BoxRequest {
    BoxParams box;
    double count = 0; ///< Of --count; 0 without.
    RunnerOptions runner;
};

std::vector<double> parse_sides(const BoxOptions& options) {
    std::size_t dimension = options.extents.size();
    if (!options.dimension.empty()) {
        const double given = parse_count("--dim", options.dimension);
        if (given > kMostBoxDimensions) {
            throw UserError(ExitCode::usage, "--dim: boxes have 1 to 6 dimensions");
        }
        if (dimension != 0 && static_cast<double>(dimension) != given) {
            throw UserError(ExitCode::usage, "--dim " + options.dimension + " and the " +
                                                 counted(dimension, "side", "sides") +
                                                 " of --extents contradict each other");
        }
        dimension = static_cast<std::size_t>(given);
    }
    if (dimension == 0) {
        throw UserError(ExitCode::usage, "no box given; give --dim, --extents or both");
    }
    if (dimension > kMostBoxDimensions) {
        throw UserError(ExitCode::usage,
                        "--extents: boxes have 1 to 6 sides, not " + std::to_string(dimension));
    }
    std::vector<double> sides(dimension, 1.0);
    for (std::size_t axis = 0; axis < options.extents.size(); ++axis) {
        const auto side = parse_real(trimmed(options.extents[axis]));
        if (!side || !(*side > 0) || !std::isfinite(*side)) {
            throw UserError(ExitCode::usage, "--extents: " + in_quotes(options.extents[axis]) +
                                                 " is not a positive, finite length");
        }
        sides[axis] = *side;
    }
    return sides;
}

BoxRequest parse_request(const BoxOptions& options) {
    if (options.min_distance.empty() == options.count.empty()) {
        throw UserError(ExitCode::usage,
                        options.count.empty()
                            ? "no distance given; give one of --min-distance and --count"
                            : "--min-distance and --count contradict each other; give just one");
    }
    BoxRequest request;
    BoxParams& box = request.box;
    box.extents = parse_sides(options);
    box.is_periodic = options.is_periodic;
    box.seed = options.run.parsed_seed();
    box.pool_ratio = parse_ratio("--pool-ratio", options.pool_ratio, 1, 10000);
    if (options.count.empty()) {
        box.min_distance =
            parse_length("--min-distance", options.min_distance).in_mesh_units(diagonal_of(box));
    } else {
        request.count = parse_count("--count", options.count);
        box.min_distance = distance_for_count(box, request.count);
    }
    request.runner.pool_bytes = options.run.pool_bytes();
    take(pool_size(box)); // Fails before a device is needed.
    return request;
}

void check_outputs(const BoxOptions& options, const BoxParams& box) {
    check_distinct({{"the samples", options.output}, {"the report", options.run.json}}, {});
    check_output_path(options.output);
    check_box_dimension(options.output, static_cast<std::uint32_t>(box.extents.size()));
    check_report_path(options.run.json);
}

std::vector<double> sample_on_device(const BoxOptions& options, const RunnerOptions& runner_options,
                                     const Domain& domain, BoxReport& report,
                                     ProgressLine& progress) {
    const Context context =
        open_device(options.run.device, options.run.validate, report.seconds.device, progress);
    report.device = context.report();
    Runner runner =
        open_runner(context, runner_options, domain, report.seconds.pipelines, progress);
    report.tuning = runner.sampler().tuning();
    progress.begin_stage("sampling");
    SampleSet set = take_run(
        runner.sample_and_wait(domain, show_progress(progress, expected_count(report.box))),
        progress);
    check_validation(context);
    report.run = set.report;
    report.samples = set.points.size() / domain.dimension();
    return std::move(set.points);
}

std::vector<SampleRow> to_rows(const std::vector<double>& points, std::size_t dimension) {
    std::vector<SampleRow> rows(points.size() / dimension);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        std::copy_n(points.begin() + static_cast<std::ptrdiff_t>(i * dimension), dimension,
                    rows[i].position);
    }
    return rows;
}

void run_box(const BoxOptions& options) {
    const BoxRequest request = parse_request(options);
    check_outputs(options, request.box);
    ProgressLine progress(options.run.quiet);
    BoxReport report;
    report.output_path = options.output;
    report.box = request.box;
    report.wanted_count = request.count;
    const Domain domain = take(Domain::box(request.box));
    const std::vector<double> points =
        sample_on_device(options, request.runner, domain, report, progress);
    write_outputs(options.output, options.run, report, progress, [&](AtomicFile& file) {
        write_box_samples(file, options.output, sample_header(report),
                          to_rows(points, domain.dimension()), options.run.ascii,
                          domain.dimension());
    });
}

} // namespace

void add_box_command(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("box", "Put samples in a box of R^n, by straight-line distance");
    const auto options = std::make_shared<BoxOptions>();
    command
        ->add_option("-o,--output", options->output,
                     "File to write: *.csv, *.ply (binary; 0 for coordinates that a\n"
                     "box of fewer than three lacks) or *.xyz (positions only)")
        ->type_name("OUT")
        ->required();

    const char* const box = "Box";
    command->add_option("--dim", options->dimension, "Dimensions, 1 to 6; sides of 1")
        ->type_name("N")
        ->group(box);
    command
        ->add_option("--extents", options->extents, "Sides instead; the box begins at the origin")
        ->type_name("A,...")
        ->delimiter(',')
        ->group(box);
    command
        ->add_flag("--periodic", options->is_periodic,
                   "Glue opposite sides together: distances go around")
        ->group(box);

    const char* const distance = "Distance, give one";
    command
        ->add_option("-d,--min-distance", options->min_distance,
                     "Least distance, in the units of the sides, or with %\n"
                     "of the diagonal")
        ->type_name("D")
        ->group(distance);
    command
        ->add_option("-n,--count", options->count,
                     "Choose the distance that should give about N samples")
        ->type_name("N")
        ->group(distance);

    command
        ->add_option("--pool-ratio", options->pool_ratio,
                     "Candidates per expected sample, 1 to 10000; more leave fewer gaps")
        ->type_name("Q")
        ->capture_default_str();
    add_run_options(*command, options->run);
    command->callback([options] { run_box(*options); });
}

} // namespace geodisk::tools
