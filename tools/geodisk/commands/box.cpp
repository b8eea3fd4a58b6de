#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/domain.hpp>

#include "geodisk/checks/run_warnings.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/device_run.hpp"
#include "geodisk/dry_run.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/box_report.hpp"
#include "program/arguments.hpp"
#include "program/command.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kExamples[] = {
    "geodisk box -o points.csv --dim 2 --count 1000 --periodic",
    "geodisk box -o points.npz --extents 2,1,1 --min-distance 0.1",
    "geodisk box -o points.csv --dim 4 --count 1e4 --periodic",
};

/// As given on the command line.
struct BoxOptions {
    std::string dimension, min_distance, count, extents;
    bool is_periodic = false;
    MethodOptions method;
    OutputOptions out;
    RunOptions run;
};

/// The parts between commas, empty ones as well; none of "".
std::vector<std::string> parts_of(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream stream(text.empty() ? text : text + ',');
    for (std::string part; std::getline(stream, part, ',');) {
        parts.push_back(part);
    }
    return parts;
}

std::vector<double> parse_sides(const BoxOptions& options) {
    const std::vector<std::string> extents = parts_of(options.extents);
    std::size_t dimension = extents.size();
    if (!options.dimension.empty()) {
        const double given = parse_count("--dim", options.dimension);
        if (given > kMostBoxDimensions) {
            fail_usage("--dim: boxes have 1 to 6 dimensions");
        }
        if (dimension != 0 && static_cast<double>(dimension) != given) {
            fail_usage("--dim " + options.dimension + " and the " +
                       counted(dimension, "side", "sides") + " of --extents contradict each other");
        }
        dimension = static_cast<std::size_t>(given);
    }
    if (dimension == 0) {
        fail_usage("no box given; give --dim, --extents or both");
    }
    if (dimension > kMostBoxDimensions) {
        fail_usage("--extents: boxes have 1 to 6 sides, not " + std::to_string(dimension));
    }
    std::vector<double> sides(dimension, 1.0);
    for (std::size_t axis = 0; axis < extents.size(); ++axis) {
        const auto side = parse_real(trimmed(extents[axis]));
        if (!side || !(*side > 0) || !std::isfinite(*side)) {
            fail_usage("--extents: " + in_quotes(extents[axis]) +
                       " is not a positive, finite length");
        }
        sides[axis] = *side;
    }
    return sides;
}

BoxJob parse_job(const BoxOptions& options) {
    check_one_distance(options.method,
                       {{"--min-distance", options.min_distance}, {"--count", options.count}});
    BoxJob job;
    job.out = options.out;
    job.run = options.run;
    BoxParams& box = job.box;
    box.extents = parse_sides(options);
    box.is_periodic = options.is_periodic;
    box.seed = options.run.parsed_seed();
    job.method = parse_method(options.method, options.count);
    box.pool_ratio = job.method.pool_ratio;
    box.stop_count = job.method.stop_count;
    if (!options.min_distance.empty()) {
        box.min_distance =
            parse_length("--min-distance", options.min_distance).in_mesh_units(diagonal_of(box));
    } else {
        job.wanted_count = parse_count("--count", options.count);
        box.min_distance = distance_for_count(box, job.wanted_count);
    }
    box.throws = job.method.throws_for(expected_count(box));
    job.runner.device_bytes = options.run.device_bytes();
    job.runner.stall_seconds = options.run.stall_seconds();
    job.runner.sampler.count_calls = job.method.counts_calls;
    return job;
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
    check_output_or_dry_run(options.out);
    BoxJob job = parse_job(options);
    const auto dimension = static_cast<std::uint32_t>(job.box.extents.size());
    check_outputs(job.out, "the samples", {});
    if (!job.out.output.empty()) {
        check_box_dimension(job.out.target(), dimension);
    }
    ProgressLine progress(job.out.quiet);
    const auto task_at = [&](double min_distance) {
        job.box.min_distance = min_distance;
        return Task{take(Domain::box(job.box)), job.method.expected(expected_count(job.box))};
    };
    RunDevice device(job.run.device, job.runner);
    if (job.out.is_dry_run) {
        const DryRun dry = dry_run_on_device(device, task_at(job.box.min_distance),
                                             job.box.min_distance, job.box.seed, progress);
        publish(job.out, dry_box_json(job, dry), dry_box_text(job, dry));
        return;
    }
    const auto [set, done] = device.run(task_at, job.box.min_distance, job.wanted_count, progress);
    job.box.min_distance = done.min_distance;
    const std::vector<SampleRow> rows = to_rows(set.points, dimension);
    job.method.check_count(rows.size(), job.box.min_distance, done.run.candidates);
    if (const std::string text = shortfall(job.method, rows.size()); !text.empty()) {
        print_warning(text);
    }
    const bool is_full = job.wanted_count == 0 && !job.method.throws_darts;
    if (is_full && rows.size() == 1) {
        print_warning("there is a single sample: the minimum distance of " +
                      rounded(job.box.min_distance, 6) + " is larger than the box has room for");
    }
    const BoxReport report(job, rows.size(), done);
    write_outputs(job.out, "the samples", progress, report, [&](AtomicFile& file) {
        write_box_samples(file, job.out.target(), report.header(), rows, dimension);
    });
}

} // namespace

void add_box_command(Command app) {
    const Command command =
        app.add_command("box", "Put samples in a box of R^n, by straight-line distance");
    const auto options = std::make_shared<BoxOptions>();
    add_output_or_dry_run(command, options->out,
                          "File to write: *.csv, *.npz, or with 0 for coordinates that a box\n"
                          "of fewer than three lacks *.ply, *.pcd, *.glb, *.gltf, *.obj, *.xyz");
    const char* const box = "Box";
    command.add_option("--dim", options->dimension, "N", "Dimensions, 1 to 6; sides of 1", box);
    command.add_option("--extents", options->extents, "A,...",
                       "Sides instead; the box begins at the origin", box);
    command.add_flag("--periodic", options->is_periodic,
                     "Glue opposite sides together: distances go around", box);
    const char* const distance = "Distance, give one";
    command.add_option("-d,--min-distance", options->min_distance, "D",
                       "Least distance, in the units of the sides, or with %\n"
                       "of the diagonal",
                       distance);
    command.add_option("-n,--count", options->count, "N",
                       "Choose the distance that should give about N samples;\n"
                       "with --method pdts, stop at exactly N",
                       distance);
    add_method_options(command, options->method, "the box");
    add_calls_option(command, options->method);
    add_run_options(command, options->run);
    add_output_options(command, options->out);
    add_verbose_option(command, options->run.device);
    command.has_footer(help_footer(kExamples));
    command.calls([options] { run_box(*options); });
}

} // namespace geodisk::tools
