// Fig. 14: packing density against |P|/|S| in the unit square, beside that of maximal sampling
// (section 6.4).
#include <algorithm>
#include <cmath>

#include <geodisk/params.hpp>

#include "baselines/box_darts.hpp"
#include "paper/commands.hpp"
#include "paper/options.hpp"
#include "paper/outputs.hpp"
#include "program/arguments.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::paper {
namespace {

/// Values of the program of Ebeida et al. 2012, the mean of ten runs.
constexpr double kPrintedRho = 0.7791;
constexpr double kPrintedRadius = 0.005;

struct Options {
    CommonOptions common;
    std::string radius = "0.005";
    NumberList ratios{"", {"5", "10", "20", "40", "80", "160", "320"}};
};

/// Results of repeated runs.
struct Densities {
    double samples = 0; ///< Mean.
    double mean = 0, least = 1e9, most = 0;

    void add(double count, double rho, int repeats) {
        samples += count / repeats;
        mean += rho / repeats;
        least = std::min(least, rho);
        most = std::max(most, rho);
    }
};

/// `sample(box, seed)` returns coordinates.
template <class Sample>
Densities measured(const Options& options, const ref::Box& box, double min_distance,
                   Sample&& sample) {
    Densities densities;
    for (int i = 0; i < options.common.repeats; ++i) {
        tools::check_interrupted();
        const std::vector<double> points = sample(box, options.common.seed_of(i));
        const std::size_t samples = points.size() / 2;
        const auto count = static_cast<double>(samples);
        densities.add(count, packing_density(1, min_distance, count), options.common.repeats);
    }
    return densities;
}

void add_row(Table& table, const std::string& method, const std::string& domain,
             const std::string& candidates, double pool, const Densities& densities) {
    table.add({method, domain, candidates,
               pool > 0 ? tools::fixed(pool / densities.samples, 1) : "",
               tools::fixed(densities.samples, 0), tools::fixed(densities.mean, 4),
               tools::fixed(densities.least, 4), tools::fixed(densities.most, 4)});
}

void add_level(LinePlot& plot, const std::string& label, double rho,
               const std::vector<bench::Point>& along) {
    if (!along.empty()) {
        plot.lines.push_back(
            {label, plot.lines.size(), true, {{along.front().x, rho}, {along.back().x, rho}}});
    }
}

void run(const Options& options) {
    Outputs outputs(options.common.out, "fig14");
    const double radius = tools::parse_ratio("--radius", options.radius, 1e-4, 0.2);
    const std::vector<double> ratios = options.ratios.ratios(1, 10000);
    const double min_distance = 2 * radius;
    const double expected = expected_count(1, min_distance);

    Table table({"method", "square", "|P|", "|P|/|S|", "samples", "rho", "least", "most"});
    LinePlot plot;
    plot.title = "Packing density in the unit square, r = " + options.radius;
    plot.x_label = "candidates per sample";
    plot.y_label = "rho";
    plot.is_linear_y = true;
    for (const bool is_periodic : {false, true}) {
        const std::string domain = is_periodic ? "periodic" : "open";
        const ref::Box box{{1, 1}, is_periodic};
        LinePlot::Line line{"from a pool, " + domain, plot.lines.size(), false, {}};
        for (const double ratio : ratios) {
            const auto size = static_cast<std::uint32_t>(std::min(ratio * expected, 4e9));
            const Densities densities =
                measured(options, box, min_distance, [&](const ref::Box& in, std::uint64_t seed) {
                    return ref::throw_in_order(in, min_distance, ref::draw_points(in, size, seed));
                });
            add_row(table, "pool", domain, std::to_string(size), size, densities);
            line.points.push_back({size / densities.samples, densities.mean});
        }
        const std::vector<bench::Point> along = line.points;
        plot.lines.push_back(std::move(line));
        const Densities maximal =
            measured(options, box, min_distance, [&](const ref::Box& in, std::uint64_t seed) {
                return ref::throw_until_maximal(in, min_distance, seed);
            });
        add_row(table, "maximal", domain, "", 0, maximal);
        add_level(plot, "maximal, " + domain, maximal.mean, along);
        if (!is_periodic && radius == kPrintedRadius) {
            add_row(table, "maximal, r apart", domain, "", 0,
                    measured(options, box, radius, [&](const ref::Box& in, std::uint64_t seed) {
                        return ref::throw_until_maximal(in, radius, seed);
                    }));
            table.add({"maximal, paper", "", "", "", "", "0.7791", "0.778", "0.780"});
            add_level(plot, "maximal, paper", kPrintedRho, along);
        }
    }
    outputs.add_table(
        table, {"radius " + options.radius, options.common.text()},
        "Packing density in the unit square, r = " + options.radius + ", " +
            std::to_string(options.common.repeats) + " runs each",
        "In an open square rho profits from samples near the border, whose disks reach out,"
        "\nthe less the smaller they are. The paper does not name its square's kind; its"
        "\nmaximal value is that of an open one whose samples are r apart, not 2 r.");
    outputs.add_plot("", plot);
    outputs.write();
}

} // namespace

void add_fig14(tools::Command app) {
    add_figure<Options>(app, "fig14", "Fig. 14: rho against |P|/|S| in the unit square", 10, run,
                        [](tools::Command command, Options& options) {
                            command
                                .add_option("--radius", options.radius, "R",
                                            "Half of the minimum distance, 0.0001 to 0.2")
                                .shows_default();
                            add_list(command, options.ratios, "--ratios",
                                     "Candidates per expected sample, 1 to 10000");
                        });
}

} // namespace geodisk::paper
