// Sections 5.9 and 6: speed in boxes of one to six dimensions, beside sequential methods.

#include <geodisk/box.hpp>

#include "baselines/box_darts.hpp"
#include "bench/statistics.hpp"
#include "kernels/grid.hpp"
#include "paper/commands.hpp"
#include "paper/device.hpp"
#include "paper/options.hpp"
#include "paper/outputs.hpp"
#include "program/arguments.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/stopwatch.hpp"

namespace geodisk::paper {
namespace {

/// Samples per second of the paper on a GTX 580, by dimension.
constexpr const char* kPrintedSpeeds[kMaxBoxDimensions + 1] = {"", "", "13", "1.5", "", "", ""};

struct Options {
    CommonOptions common;
    std::string device;
    std::string count = "10000";
    std::string trials = "30";
    NumberList dimensions{"", {"1", "2", "3", "4", "5", "6"}};
    bool is_open = false;
};

/// Samples and the median of seconds.
struct Speed {
    double samples = 0;
    std::vector<double> seconds;

    double per_second() const { return samples / bench::median(seconds); }
};

/// Adds a run of `work`, which returns how many samples it found.
template <class Work>
void add_run(Speed& speed, Work&& work) {
    tools::check_interrupted();
    const tools::Stopwatch watch;
    speed.samples = static_cast<double>(work());
    speed.seconds.push_back(watch.seconds());
}

void check_equal(const SampleSet& set, const BoxParams& box) {
    const ref::BoxPool<float> pool(box);
    const ref::BoxLattice lattice(box);
    std::vector<double> points;
    for (const std::uint32_t rank : ref::throw_darts(pool)) {
        for (std::size_t axis = 0; axis < box.extents.size(); ++axis) {
            points.push_back(lattice.coordinate(axis, pool.points[pool.places[rank]]));
        }
    }
    if (set.points != points) {
        throw tools::UserError(tools::ExitCode::internal,
                               std::to_string(box.extents.size()) +
                                   " dimensions: device and reference differ");
    }
}

void add_dimension(const Options& options, const Context& context, std::uint32_t dimension,
                   Table& table) {
    BoxParams box;
    box.extents.assign(dimension, 1.0);
    box.is_periodic = !options.is_open;
    box.seed = options.common.seed;
    box.min_distance = distance_for_count(box, tools::parse_count("--count", options.count));
    const auto trials =
        static_cast<std::uint32_t>(tools::parse_ratio("--trials", options.trials, 1, 1000));
    Runner runner =
        tools::take(Runner::create(context.device(), context.queue(), kept_options(context)));
    check_equal(run_box(runner, box), box);
    Speed device, reference, around;
    for (int i = 0; i < options.common.repeats; ++i, ++box.seed) {
        const SampleSet set = run_box(runner, box);
        device.samples = static_cast<double>(set.points.size()) / dimension;
        device.seconds.push_back(set.report.seconds.sample);
        add_run(reference, [&] { return ref::throw_darts(ref::BoxPool<double>(box)).size(); });
        add_run(around, [&] {
            return ref::throw_around_samples({box.extents, box.is_periodic}, box.min_distance,
                                             trials, box.seed)
                       .size() /
                   dimension;
        });
    }
    table.add({std::to_string(dimension), tools::rounded(box.min_distance, 6),
               tools::fixed(device.samples, 0), tools::fixed(device.per_second() / 1e6, 3),
               tools::fixed(reference.per_second() / 1e6, 3), tools::fixed(around.samples, 0),
               tools::fixed(around.per_second() / 1e6, 3), kPrintedSpeeds[dimension]});
}

void run(const Options& options) {
    Outputs outputs(options.common.out, "boxes", /* has_plots */ false);
    const std::vector<double> dimensions = options.dimensions.ratios(1, kMaxBoxDimensions);
    tools::parse_count("--count", options.count); // Fails before a device is needed.
    const Context context = open_context(options.device);
    Table table({"n", "distance", "samples", "device M/s", "sequential M/s", "around: samples",
                 "M/s", "paper M/s"});
    for (const double dimension : dimensions) {
        add_dimension(options, context, static_cast<std::uint32_t>(dimension), table);
    }
    const std::string kind = options.is_open ? "open" : "periodic";
    outputs.add_table(table,
                      {"device " + context.report().name, "count " + options.count,
                       kind + " unit boxes, " + options.trials + " trials", options.common.text()},
                      "Unit boxes of n dimensions, " + kind +
                          ", millions of samples per second on " +
                          tools::one_line(context.report().name) + ", medians of " +
                          std::to_string(options.common.repeats) + " runs",
                      "Sequential returns the device's samples, on one core in double precision."
                      "\nAround darts " +
                          options.trials +
                          " darts around samples (Bridson 2007), on one core as well."
                          "\nThe paper's device is a GTX 580 of 2010.");
    outputs.write();
}

} // namespace

void add_boxes(tools::Command app) {
    add_figure<Options>(
        app, "boxes", "Sections 5.9 and 6: speed in boxes of R^n, on a device and sequentially", 5,
        run, [](tools::Command command, Options& options) {
            command.add_option("-n,--count", options.count, "N", "Target number of samples")
                .shows_default();
            add_list(command, options.dimensions, "--dims", "Dimensions, 1 to 6");
            command.add_flag("--open", options.is_open, "Use boxes that are not periodic");
            command
                .add_option("--trials", options.trials, "K",
                            "Darts around a sample before it retires, 1 to 1000")
                .shows_default();
            add_device(command, options.device);
        });
}

} // namespace geodisk::paper
