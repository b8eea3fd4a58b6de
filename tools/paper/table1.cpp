// Table 1: how often CheckStatus calls itself (section 5.4), in the sequential reference.
#include <algorithm>
#include <array>

#include "baselines/batches.hpp"
#include "baselines/geodesic_disks.hpp"
#include "paper/commands.hpp"
#include "paper/options.hpp"
#include "paper/outputs.hpp"
#include "paper/pool.hpp"
#include "program/arguments.hpp"
#include "program/human_text.hpp"

namespace geodisk::paper {
namespace {

struct Options {
    CommonOptions common;
    std::string mesh;
    std::string count = "10000";
    NumberList pool_ratios{"", {"20", "5"}};
    NumberList ratios{"", {"5", "10", "20", "40"}};
};

/// A row of the printed table: percentages of 1, 2, ..., 9 and 10 or more calls, on Gargoyle.
struct PrintedRow {
    double ratio;
    std::array<double, 10> percent;
};
constexpr PrintedRow kPrinted[] = {
    {5, {75.94, 21.45, 2.16, 0.15, 0.13, 0.09, 0.03, 0.02, 0.02, 0.01}},
    {10, {84.27, 14.25, 0.81, 0.52, 0.07, 0.04, 0.02, 0.01, 0.01, 0}},
    {20, {91.39, 8.30, 0.15, 0.14, 0.02, 0.01, 0, 0, 0, 0}},
    {40, {95.32, 4.58, 0.06, 0.04, 0, 0, 0, 0, 0, 0}}};

std::vector<std::string> columns() {
    std::vector<std::string> names{"N/T", "source", "|P|/N"};
    for (int calls = 1; calls < 10; ++calls) {
        names.push_back(std::to_string(calls));
    }
    names.insert(names.end(), {">=10", "mean", "disks/sample"});
    return names;
}

/// `group` is that of the ratio: measured and printed lines share a colour.
void add_line(LinePlot& plot, const std::string& label, std::size_t group, bool is_printed,
              const std::array<double, 10>& percent) {
    LinePlot::Line line{label, group, is_printed, {}};
    for (std::size_t i = 0; i < percent.size(); ++i) {
        line.points.push_back({static_cast<double>(i + 1), percent[i]});
    }
    plot.lines.push_back(std::move(line));
}

/// Adds the printed row for the same ratio where there is one.
void add_printed(Table& table, LinePlot& plot, double ratio, std::size_t group) {
    for (const PrintedRow& printed : kPrinted) {
        if (printed.ratio != ratio) {
            continue;
        }
        std::vector<std::string> cells{tools::rounded(ratio, 4), "paper", ""};
        double mean = 0;
        for (std::size_t i = 0; i < printed.percent.size(); ++i) {
            cells.push_back(tools::fixed(printed.percent[i], 2));
            mean += printed.percent[i] / 100 * static_cast<double>(i + 1);
        }
        cells.insert(cells.end(), {tools::fixed(mean, 3), ""});
        table.add(std::move(cells));
        add_line(plot, "N/T = " + tools::rounded(ratio, 4) + ", paper", group, true,
                 printed.percent);
    }
}

/// Costs of the batches of repeated runs.
struct Measured {
    CallHistogram calls;
    double samples = 0;

    void add(const CallHistogram& run, std::size_t run_samples) {
        for (std::size_t i = 0; i < run.candidates.size(); ++i) {
            calls.candidates[i] += run.candidates[i];
        }
        calls.calls += run.calls;
        samples += static_cast<double>(run_samples);
    }
};

/// A row of the table: its ratios, and the T they make.
struct Setup {
    double count, ratio, pool_ratio;

    /// At least as many as a device takes.
    std::uint32_t slots() const {
        return static_cast<std::uint32_t>(std::clamp(count / ratio, double{kMinSlots}, 4e9));
    }
};

Measured measure(const PaperMesh& mesh, const CommonOptions& common, const Setup& setup) {
    Measured sum;
    for (int i = 0; i < common.repeats; ++i) {
        const Pool pool =
            draw_pool(mesh, params_for(mesh, setup.count, setup.pool_ratio, common.seed_of(i)));
        ref::GeodesicDisks query(mesh.prepared, pool.params.min_distance, pool.by_rank,
                                 pool.tolerances);
        CallHistogram calls;
        const ref::BatchRun batches = ref::run_batches(query, setup.slots(), &calls);
        sum.add(calls, batches.ranks.size());
    }
    return sum;
}

/// Returns the percentages.
std::array<double, 10> add_measured(Table& table, const Setup& setup, const std::string& source,
                                    const Measured& measured) {
    std::vector<std::string> cells{tools::rounded(setup.ratio, 4), source,
                                   tools::rounded(setup.pool_ratio, 4)};
    std::array<double, 10> percent{};
    for (std::size_t i = 0; i < percent.size(); ++i) {
        percent[i] = 100 * measured.calls.share(i);
        cells.push_back(tools::fixed(percent[i], 2));
    }
    const auto active = static_cast<double>(measured.calls.total());
    cells.insert(cells.end(), {tools::fixed(measured.calls.mean(), 3),
                               tools::fixed(active / measured.samples, 3)});
    table.add(std::move(cells));
    return percent;
}

void run(const Options& options) {
    Outputs outputs(options.common.out, "table1");
    const double count = tools::parse_count("--count", options.count);
    const std::vector<double> pool_ratios = options.pool_ratios.ratios(1, 10000);
    const std::vector<double> ratios = options.ratios.ratios(0.01, 1e9);
    const PaperMesh mesh = load_mesh(options.mesh);

    Table table(columns());
    LinePlot plot;
    plot.title = "Calls of CheckStatus, " + mesh.name +
                 ", |P|/N = " + tools::rounded(pool_ratios.front(), 4);
    plot.x_label = "calls, the last point for 10 and more";
    plot.y_label = "active candidates in percent";
    for (std::size_t group = 0; group < ratios.size(); ++group) {
        const double ratio = ratios[group];
        for (const double pool_ratio : pool_ratios) {
            const Setup setup{count, ratio, pool_ratio};
            const std::array<double, 10> percent =
                add_measured(table, setup, "measured", measure(mesh, options.common, setup));
            // One pool is enough to draw.
            if (pool_ratio == pool_ratios.front()) {
                add_line(plot, "N/T = " + tools::rounded(ratio, 4), group, false, percent);
            }
        }
        add_printed(table, plot, ratio, group);
    }
    outputs.add_table(
        table, {"mesh " + mesh.name, "count " + options.count, options.common.text()},
        "Calls of CheckStatus, percent of active candidates",
        "The paper does not name |P|/N. The fewer candidates, the fewer of them crowd in the"
        "\nlast gaps, where most conflicts are.");
    outputs.add_plot("", plot);
    outputs.write();
}

} // namespace

void add_table1(tools::Command app) {
    add_figure<Options>(app, "table1", "Table 1: recursive calls of CheckStatus by N/T", 5, run,
                        [](tools::Command command, Options& options) {
                            command
                                .add_option("MESH", options.mesh, "",
                                            "Mesh: *.obj, *.ply or builtin:NAME[:RESOLUTION]")
                                .required();
                            command
                                .add_option("-n,--count", options.count, "N",
                                            "Target number of samples (the paper's N)")
                                .shows_default();
                            add_list(command, options.pool_ratios, "--pool-ratios",
                                     "Candidates per expected sample, 1 to 10000");
                            add_list(command, options.ratios, "--ratios",
                                     "Samples per active candidate (N/T)");
                        });
}

} // namespace geodisk::paper
