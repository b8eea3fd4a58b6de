// Fig. 7: samples that distances through space lose where parts of a surface lie close together or
// cross, and exact distances do not (section 6.1).
#include <array>
#include <optional>

#include "paper/commands.hpp"
#include "paper/device.hpp"
#include "paper/metrics.hpp"
#include "paper/options.hpp"
#include "paper/outputs.hpp"
#include "paper/painter.hpp"
#include "program/arguments.hpp"
#include "program/human_text.hpp"

namespace geodisk::paper {
namespace {

struct Options {
    CommonOptions common;
    std::string device;
    NumberList distances{"", {"0.05", "0.1", "0.2"}};
    PanelSize size;
};

struct Surface {
    const char* mesh;
    const char* flat; ///< The same surface laid flat, if that is possible.
};
constexpr Surface kSurfaces[] = {
    {"builtin:plate", nullptr},
    {"builtin:folded-sheet", "builtin:unfolded-sheet"},
    {"builtin:swiss-roll", "builtin:unrolled-sheet"},
    {"builtin:crossed-sheet", "builtin:uncrossed-sheet"},
};
constexpr const char* kCrossing = "builtin:crossed-sheet:48";

struct Comparison {
    std::array<Tally, kMetrics.size()> tallies;
    bool equals_flat = true; ///< The exact sets do, candidate by candidate.

    const Tally& of(Metric metric) const { return tallies[static_cast<std::size_t>(metric)]; }
    double lost_percent(Metric metric) const {
        return 100 * (1 - of(metric).samples / of(Metric::exact).samples);
    }
};

Comparison compare(const PaperMesh& mesh, const std::optional<PaperMesh>& flat, double distance,
                   const CommonOptions& common) {
    Comparison result;
    for (int i = 0; i < common.repeats; ++i) {
        const SampleParams params{distance, common.seed_of(i), kDefaultPoolRatio};
        const Pool pool = draw_pool(mesh, params);
        for (const Metric metric : kMetrics) {
            const std::vector<std::uint32_t> samples = throw_darts(mesh, pool, metric);
            result.tallies[static_cast<std::size_t>(metric)].add(
                samples.size(), find_violations(mesh, places_of(pool, samples), distance));
            if (metric == Metric::exact && flat) {
                result.equals_flat =
                    result.equals_flat &&
                    samples == throw_darts(*flat, draw_pool(*flat, params), metric);
            }
        }
    }
    return result;
}

struct Figure {
    Table table{{"surface", "D", "metric", "samples", "lost %", "pairs too close", "too close %",
                 "as laid flat"}};
    LinePlot plot{.title = "Samples lost to false conflicts",
                  .x_label = "minimum distance",
                  .y_label = "samples lost",
                  .y_unit = "%",
                  .is_linear_y = true};

    void begin_surface(const std::string& name) {
        const std::size_t group = plot.lines.size() / 2;
        plot.lines.push_back({name + ", straight line", group, false, {}});
        plot.lines.push_back({name + ", closed form", group, true, {}});
    }

    void add(const std::string& name, double distance, const Comparison& result, bool has_flat,
             double repeats) {
        for (const Metric metric : kMetrics) {
            const Tally& tally = result.of(metric);
            const bool is_exact = metric == Metric::exact;
            const char* const as_flat = result.equals_flat ? "same set" : "another set";
            table.add({name, tools::rounded(distance, 4), name_of(metric),
                       tools::fixed(tally.samples / repeats, 1),
                       tools::fixed(result.lost_percent(metric), 1),
                       tools::fixed(tally.pairs / repeats, 1),
                       tools::fixed(tally.close_percent(), 2),
                       is_exact && has_flat ? as_flat : ""});
        }
        (plot.lines.end() - 2)->points.push_back({distance, result.lost_percent(Metric::straight)});
        plot.lines.back().points.push_back({distance, result.lost_percent(Metric::curve)});
    }
};

/// The sheet that crosses itself: through space, by the closed form and by exact distances.
Pixels show_crossing(const Painter& painter, double distance, const Options& options) {
    const PictureParams panel = square_panel(options.size);
    const PaperMesh mesh = load_mesh(kCrossing);
    const Pool pool = draw_pool(mesh, {distance, options.common.seed, kDefaultPoolRatio});
    std::vector<Pixels> panels;
    for (const Metric metric : {Metric::straight, Metric::curve, Metric::exact}) {
        panels.push_back(painter.surface(
            mesh,
            disks_of(places_of(pool, throw_darts(mesh, pool, metric)), pool.params.min_distance),
            panel));
    }
    return side_by_side(panels);
}

void run(const Options& options) {
    Outputs outputs(options.common.out, "fig7");
    const std::vector<double> distances = options.distances.ratios(0.005, 10);
    const Context context = open_context(options.device, /* graphics */ true);
    const Painter painter(context);
    Figure figure;
    for (const Surface& surface : kSurfaces) {
        const PaperMesh mesh = load_mesh(surface.mesh);
        std::optional<PaperMesh> flat;
        if (surface.flat != nullptr) {
            flat = load_mesh(surface.flat);
        }
        figure.begin_surface(mesh.name);
        for (const double distance : distances) {
            figure.add(mesh.name, distance, compare(mesh, flat, distance, options.common),
                       flat.has_value(), options.common.repeats);
        }
    }
    outputs.add_table(
        figure.table, {options.common.text() + ", values are means"},
        "Samples that are D apart by exact distances, straight lines and the closed form of"
        "\nBowers et al., means of " +
            std::to_string(options.common.repeats) + " runs",
        "Lost are samples against those of exact distances; too close are samples whose exact"
        "\ndistance to another one is below D. The sides of the plate and the layers of the"
        "\nfolded sheet are 0.01 apart, the turns of the roll 0.05; the crossed sheet passes"
        "\nthrough itself. A surface laid flat has the same exact distances, so the same set.\n"
        "The paper gives no figures: methods that look for conflicts in space place fewer"
        "\nsamples near a self-intersection. The picture has the crossed sheet, by straight lines,"
        "\nthe closed form and exact distances.");
    outputs.add_plot("", figure.plot);
    outputs.add_picture("", show_crossing(painter, distances[distances.size() / 2], options));
    outputs.write();
}

} // namespace

void add_fig7(tools::Command app) {
    add_figure<Options>(
        app, "fig7", "Fig. 7: samples lost to false conflicts on a plate, sheets and a roll", 3,
        run, [](tools::Command command, Options& options) {
            add_list(command, options.distances, "--distances",
                     "Minimum distances, 0.005 to 10; the surfaces are about 1 wide");
            add_panel_size(command, options.size);
            add_device(command, options.device);
        });
}

} // namespace geodisk::paper
