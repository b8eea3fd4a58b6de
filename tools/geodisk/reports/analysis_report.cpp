#include "geodisk/reports/analysis_report.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include <geodisk/version.hpp>

#include "geodisk/reports/json.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "program/human_text.hpp"
#include "program/table.hpp"

namespace geodisk::tools {
namespace {

/// Distances of sets that differ by no more, relatively, come of one count.
constexpr double kAlike = 0.05;

/// Mean and standard deviation over the sets.
struct Summary {
    double mean = 0, deviation = 0;
};

template <class Of>
Summary summarize(const std::vector<SetAnalysis>& sets, const Of& of) {
    Summary summary;
    const auto count = static_cast<double>(sets.size());
    for (const SetAnalysis& set : sets) {
        summary.mean += of(set) / count;
    }
    for (const SetAnalysis& set : sets) {
        summary.deviation += std::pow(of(set) - summary.mean, 2) / std::max(1.0, count - 1);
    }
    summary.deviation = std::sqrt(summary.deviation);
    return summary;
}

Summary number_of(const std::vector<SetAnalysis>& sets) {
    return summarize(sets, [](const SetAnalysis& set) { return static_cast<double>(set.samples); });
}
Summary room_of(const std::vector<SetAnalysis>& sets) {
    return summarize(sets, [](const SetAnalysis& set) { return set.found.uncovered; });
}

/// The highest value of the pair correlation, and where.
std::pair<double, double> peak_of(const analysis::Histogram& g) {
    const auto peak = std::max_element(g.counts.begin(), g.counts.end());
    const auto bin = static_cast<double>(peak - g.counts.begin());
    return {g.counts.empty() ? 0 : *peak, (bin + 0.5) * g.width};
}

Json json_of_summary(const Summary& summary) {
    return {{"mean", summary.mean}, {"deviation", summary.deviation}};
}
Json json_of_histogram(const analysis::Histogram& histogram, const char* name) {
    return histogram.counts.empty()
               ? Json(nullptr)
               : Json{{"bin_width", histogram.width}, {name, histogram.counts}};
}

/// Returns what was found, of all classes together or of one.
Json numbers_json(const SetAnalysis& set) {
    const analysis::SurfaceStatistics& found = set.found;
    const bool has_nearest = found.lonely < set.samples;
    return {{"samples", set.samples},
            {"min_distance", set.min_distance},
            {"rho", json_of(set.rho)},
            {"reach", found.reach},
            {"smallest", has_nearest ? Json(found.smallest) : Json(nullptr)},
            {"mean_nearest", has_nearest ? Json(found.mean_nearest) : Json(nullptr)},
            {"without_neighbor", found.lonely},
            {"probes", found.probes},
            {"uncovered", found.uncovered},
            {"uncovered_error", std::sqrt(found.uncovered * (1 - found.uncovered) / found.probes)},
            {"largest_gap", found.largest_gap},
            {"components_without_samples", set.bare_components},
            {"nearest", json_of_histogram(found.nearest, "counts")},
            {"pair_correlation", json_of_histogram(found.pair_correlation, "g")}};
}

void add_row(const std::string& name, const SetAnalysis& set, Table& table) {
    const auto [peak, at] = peak_of(set.found.pair_correlation);
    const bool has_pairs = !set.found.pair_correlation.counts.empty();
    table.add(
        {name, grouped(set.samples), set.rho ? fixed(*set.rho, 3) : "",
         set.found.lonely == set.samples ? "" : fixed(set.found.smallest, 5),
         set.found.lonely == set.samples ? "" : fixed(set.found.mean_nearest, 3),
         fixed(100 * set.found.uncovered, 2) + " %",
         (set.found.largest_gap < set.found.reach ? "" : ">= ") + fixed(set.found.largest_gap, 3),
         has_pairs ? fixed(peak, 2) : "", has_pairs ? fixed(at, 3) : "",
         grouped(set.bare_components)});
}

} // namespace

bool are_alike(const std::vector<SetAnalysis>& sets) {
    const auto [least, most] = std::minmax_element(
        sets.begin(), sets.end(),
        [](const SetAnalysis& a, const SetAnalysis& b) { return a.min_distance < b.min_distance; });
    return sets.empty() || most->min_distance <= (1 + kAlike) * least->min_distance;
}

Json set_json(const SetAnalysis& set) {
    Json json{{"samples_file", set.path}};
    json.update(numbers_json(set));
    Json& classes = json["classes"] = Json::array();
    for (const SetAnalysis& one : set.classes) {
        classes.push_back(numbers_json(one));
    }
    return json;
}

std::string report_text(const Analysis& analysis) {
    std::ostringstream out;
    out << mesh_lines("mesh", analysis.mesh);
    Table table({"samples of", "number", "rho", "smallest", "mean\nnearest", "room\nfor more",
                 "largest\ngap", "pairs\npeak", "at", "bare\nparts"});
    bool has_classes = false;
    for (const SetAnalysis& set : analysis.sets) {
        add_row(one_line(set.path), set, table);
        for (std::size_t number = 0; number < set.classes.size(); ++number) {
            add_row("  class " + std::to_string(number), set.classes[number], table);
        }
        has_classes |= !set.classes.empty();
    }
    out << table.text() << "distances are along the surface, in minimum distances"
        << (has_classes ? ", those of the classes\n" : "\n");
    if (analysis.sets.size() > 1 && are_alike(analysis.sets)) {
        const auto line = [&](const char* name, int decimals, const Summary& of) {
            out << padded(name, 14) << fixed(of.mean, decimals) << " on average, deviating by "
                << fixed(of.deviation, decimals) << '\n';
        };
        line("number", 1, number_of(analysis.sets));
        line("room for more", 5, room_of(analysis.sets));
    }
    if (analysis.evenness) {
        out << "evenness      chi^2 " << rounded(analysis.evenness->chi_square, 3) << " with "
            << analysis.evenness->freedom << " degrees of freedom, p "
            << rounded(analysis.evenness->p, 2) << "; counts vary "
            << rounded(analysis.evenness->dispersion, 2)
            << " times as much as those of independent points\n";
    }
    return out.str();
}

std::string report_json(const Analysis& analysis) {
    const bool alike = are_alike(analysis.sets);
    Json sets = Json::array();
    for (const SetAnalysis& set : analysis.sets) {
        sets.push_back(set_json(set));
    }
    Json document{{"version", GEODISK_VERSION_STRING},
                  {"mesh", mesh_json(analysis.mesh)},
                  {"warnings", warnings_json(analysis.warnings)},
                  {"sets", sets},
                  {"number", alike ? json_of_summary(number_of(analysis.sets)) : Json(nullptr)},
                  {"uncovered", alike ? json_of_summary(room_of(analysis.sets)) : Json(nullptr)},
                  {"evenness", nullptr}};
    if (analysis.evenness) {
        document["evenness"] = {{"sets", analysis.evenness->sets},
                                {"regions", analysis.evenness->regions},
                                {"dispersion", analysis.evenness->dispersion},
                                {"chi_square", analysis.evenness->chi_square},
                                {"degrees_of_freedom", analysis.evenness->freedom},
                                {"p", analysis.evenness->p}};
    }
    return text_of(document);
}

} // namespace geodisk::tools
