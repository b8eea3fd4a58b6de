// Fig. 13: what the closed form of Bowers et al. 2010 saves against exact distances, and priorities
// beside phase groups with the same closed form (section 6.1).
#include <algorithm>

#include "baselines/batches.hpp"
#include "baselines/geodesic_disks.hpp"
#include "baselines/phase_groups.hpp"
#include "baselines/space_disks.hpp"
#include "bench/statistics.hpp"
#include "paper/commands.hpp"
#include "paper/metrics.hpp"
#include "paper/options.hpp"
#include "paper/outputs.hpp"
#include "paper/pool.hpp"
#include "program/arguments.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/stopwatch.hpp"

namespace geodisk::paper {
namespace {

struct Options {
    CommonOptions common;
    std::vector<std::string> meshes;
    NumberList counts{"", {"300", "1000", "3000", "10000", "30000"}};
    std::string ratio = "20";
    std::string trials;
};

/// Results of one pool. Times include neither the pool nor the cells of its points.
struct Comparison {
    double exact_seconds, curve_seconds, phase_seconds;
    double samples;       ///< By priorities and the closed form.
    double disks;         ///< Computed for them.
    double phase_samples; ///< By phase groups.
    double close_samples; ///< By priorities, with an exact distance below the minimum.

    double speed_up() const { return exact_seconds / curve_seconds; }
    /// Speed in samples per second, priorities by phase groups.
    double relative() const { return (samples / curve_seconds) / (phase_samples / phase_seconds); }
};

Comparison compare(const PaperMesh& mesh, const Pool& pool, std::uint32_t slots,
                   std::uint32_t trials) {
    const double distance = pool.params.min_distance;
    const auto points = ref::oriented_points(mesh.view(), pool.by_rank);
    std::vector<glm::dvec3> positions;
    positions.reserve(points.size());
    for (const ref::OrientedPoint& point : points) {
        positions.push_back(point.position);
    }
    ref::GeodesicDisks exact(mesh.prepared, distance, pool.by_rank, pool.tolerances);
    ref::SpaceDisks curve(points, distance, ref::curve_length);
    const ref::PhaseGroups groups(positions, distance);

    Comparison result{};
    ref::BatchRun batches;
    std::vector<std::uint32_t> phases;
    tools::check_interrupted();
    result.exact_seconds = tools::seconds_of([&] { batches = ref::run_batches(exact, slots); });
    tools::check_interrupted();
    result.curve_seconds = tools::seconds_of([&] { batches = ref::run_batches(curve, slots); });
    result.phase_seconds = tools::seconds_of([&] { phases = groups.throw_darts(curve, trials); });
    result.samples = static_cast<double>(batches.ranks.size());
    result.disks = static_cast<double>(batches.disks);
    result.phase_samples = static_cast<double>(phases.size());
    result.close_samples = static_cast<double>(
        find_violations(mesh, places_of(pool, batches.ranks), distance).samples);
    return result;
}

/// The median of a quantity over repetitions.
template <class Quantity>
double middle(const std::vector<Comparison>& runs, Quantity&& quantity) {
    std::vector<double> values;
    values.reserve(runs.size());
    for (const Comparison& one : runs) {
        values.push_back(quantity(one));
    }
    return bench::median(values);
}

struct Figure {
    Table table{{"mesh", "samples", "exact s", "closed form s", "speed-up", "phase groups s",
                 "phase samples", "relative %", "samples/disk %", "too close %"}};
    LinePlot speed_up, relative;

    explicit Figure(const std::string& ratio) {
        speed_up.title = "Speed-up by the closed form";
        speed_up.y_label = "times as fast as with exact distances";
        relative.title = "Priorities by phase groups, N/T = " + ratio;
        relative.y_label = "relative speed";
        relative.y_unit = "%";
        relative.is_linear_y = true;
        speed_up.x_label = relative.x_label = "samples";
    }

    void begin_mesh(const std::string& name) {
        speed_up.lines.push_back({name, speed_up.lines.size(), false, {}});
        const std::size_t group = relative.lines.size() / 2;
        relative.lines.push_back({name + ", time", group, false, {}});
        relative.lines.push_back({name + ", samples per disk", group, true, {}});
    }

    void add(const std::string& mesh, const std::vector<Comparison>& runs) {
        const auto of = [&runs](auto quantity) { return middle(runs, quantity); };
        const double samples = of([](const Comparison& c) { return c.samples; });
        const double gain = of([](const Comparison& c) { return c.speed_up(); });
        const double part = 100 * of([](const Comparison& c) { return c.relative(); });
        const double per_disk = 100 * of([](const Comparison& c) { return c.samples / c.disks; });
        const double close =
            100 * of([](const Comparison& c) { return c.close_samples / c.samples; });
        table.add({mesh, tools::fixed(samples, 0),
                   tools::fixed(of([](const Comparison& c) { return c.exact_seconds; }), 4),
                   tools::fixed(of([](const Comparison& c) { return c.curve_seconds; }), 4),
                   tools::fixed(gain, 2),
                   tools::fixed(of([](const Comparison& c) { return c.phase_seconds; }), 4),
                   tools::fixed(of([](const Comparison& c) { return c.phase_samples; }), 0),
                   tools::fixed(part, 1), tools::fixed(per_disk, 1), tools::fixed(close, 2)});
        speed_up.lines.back().points.push_back({samples, gain});
        (relative.lines.end() - 2)->points.push_back({samples, part});
        relative.lines.back().points.push_back({samples, per_disk});
    }
};

void run(const Options& options) {
    Outputs outputs(options.common.out, "fig13");
    const std::vector<double> counts = options.counts.counts();
    const double ratio = tools::parse_ratio("--ratio", options.ratio, 0.01, 1e9);
    const std::uint32_t trials =
        options.trials.empty() ? ~0u
                               : static_cast<std::uint32_t>(
                                     std::min(tools::parse_count("--trials", options.trials), 4e9));
    const std::vector<PaperMesh> meshes = load_meshes(options.meshes);

    Figure figure(options.ratio);
    for (const PaperMesh& mesh : meshes) {
        figure.begin_mesh(mesh.name);
        for (const double count : counts) {
            std::vector<Comparison> runs;
            for (int i = 0; i < options.common.repeats; ++i) {
                const Pool pool = draw_pool(
                    mesh, params_for(mesh, count, kDefaultPoolRatio, options.common.seed_of(i)));
                const auto slots = static_cast<std::uint32_t>(std::max(count / ratio, 1.0));
                runs.push_back(compare(mesh, pool, slots, trials));
            }
            figure.add(mesh.name, runs);
        }
    }
    outputs.add_table(
        figure.table,
        {"N/T " + options.ratio, "trials " + (options.trials.empty() ? "all" : options.trials),
         options.common.text() + ", values are medians"},
        "Exact distances, the closed form of Bowers et al., and phase groups with it;\n"
        "sequential, one core, medians of " +
            std::to_string(options.common.repeats) + " runs, N/T = " + options.ratio,
        "The paper, on a GPU: (a) a significant speed-up where N is small, none to speak of"
        "\nwhere it is large; (b) 85 to 95 % of the speed of phase groups. On one core only"
        "\nthe work differs, so samples per disk is what compares with (b).");
    outputs.add_plot("a", figure.speed_up);
    outputs.add_plot("b", figure.relative);
    outputs.write();
}

} // namespace

void add_fig13(tools::Command app) {
    add_figure<Options>(
        app, "fig13", "Fig. 13: exact distances, the closed form, and phase groups", 3, run,
        [](tools::Command command, Options& options) {
            add_meshes(command, options.meshes);
            add_list(command, options.counts, "--counts", "Target sample counts");
            command.add_option("--ratio", options.ratio, "X", "Samples per active candidate (N/T)")
                .shows_default();
            command.add_option(
                "--trials", options.trials, "K",
                "Darts per cell of the phase groups; all candidates\nof the cell if not given");
        });
}

} // namespace geodisk::paper
