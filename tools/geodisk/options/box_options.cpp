#include "geodisk/options/box_options.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "program/arguments.hpp"
#include "program/command.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

std::vector<double> parse_sides(const BoxOptions& options) {
    const std::vector<std::string> extents = parts_of(options.extents);
    std::size_t dimension = extents.size();
    if (!options.dimension.empty()) {
        const double given = parse_count("--dim", options.dimension);
        if (given > kMaxBoxDimensions) {
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
    if (dimension > kMaxBoxDimensions) {
        fail_usage("--extents: boxes have 1 to 6 sides, not " + std::to_string(dimension));
    }
    std::vector<double> sides(dimension, 1.0);
    for (std::size_t axis = 0; axis < extents.size(); ++axis) {
        const auto side = parse_positive(trimmed(extents[axis]));
        if (!side) {
            fail_usage("--extents: " + in_quotes(extents[axis]) +
                       " is not a positive, finite length");
        }
        sides[axis] = *side;
    }
    return sides;
}

} // namespace

void add_box_options(Command command, BoxOptions& options) {
    const char* const box = "Box";
    command.add_option("--dim", options.dimension, "N",
                       "Number of dimensions, 1 to 6; all sides have length 1", box);
    command.add_option("--extents", options.extents, "A,...",
                       "Lengths of the sides instead; the box begins at the origin", box);
    command.add_flag("--periodic", options.is_periodic,
                     "Glue opposite sides together: distances wrap around", box);
    const char* const distance = "Distance, give one";
    command.add_option("-d,--min-distance", options.min_distance, "D",
                       "Minimum distance, in the units of the sides, or with %\n"
                       "of the diagonal",
                       distance);
    command.add_option("-n,--count", options.count, "N",
                       "Choose the distance that should give about N samples;\n"
                       "with --method darts, stop at exactly N",
                       distance);
    add_exact_option(command, options.method, distance);
    add_method_options(command, options.method, "the box");
}

RequestRun BoxJob::request() const {
    return take(RequestRun::create(BoxRequest{box, wanted_count.samples, wanted_count.is_exact}));
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
    check_class_counts(job.method, 0);
    if (job.method.params.maximal) {
        fail_usage("--maximal is for surfaces; in a box, give --dense or a higher --pool-ratio");
    }
    box.pool_ratio = job.method.params.pool_ratio;
    box.stop_count = job.method.params.stop_count;
    job.wanted_count =
        parse_wanted_count(options.method, options.count, job.method.params.pool_ratio);
    if (!options.min_distance.empty()) {
        box.min_distance =
            parse_length("--min-distance", options.min_distance).in_mesh_units(diagonal_of(box));
    } else {
        box.min_distance = distance_for_count(box, job.wanted_count.samples);
    }
    box.darts = job.method.darts_for(expected_count(box));
    job.runner = options.run.runner();
    return job;
}

double diagonal_of(const BoxParams& box) {
    const double longest = *std::max_element(box.extents.begin(), box.extents.end());
    double sum = 0;
    for (const double side : box.extents) {
        sum += (side / longest) * (side / longest);
    }
    return longest * std::sqrt(sum);
}

} // namespace geodisk::tools
