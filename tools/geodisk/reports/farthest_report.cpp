#include "geodisk/reports/farthest_report.hpp"

#include <cmath>

#include "geodisk/reports/json.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Returns a distance, or null for one that no path has.
Json distance_json(double distance) {
    return std::isfinite(distance) ? Json(distance) : Json(nullptr);
}

} // namespace

HeaderEntries farthest_entries(const FarthestRun& run) {
    HeaderEntries entries{{"order", "farthest"}};
    if (run.order.indices.size() < run.samples) {
        entries.emplace_back("kept_of", std::to_string(run.samples));
    }
    return entries;
}

Json farthest_json(const FarthestRun& run) {
    const auto& distances = run.order.distances;
    return {{"samples", run.samples},
            {"kept", run.order.indices.size()},
            {"min_cover", distances.empty() ? Json(nullptr) : distance_json(distances.back())},
            {"left_out_within", distance_json(run.order.cover)},
            {"error", run.order.error},
            {"searches", run.order.searches},
            {"disks", run.order.report.disks},
            {"windows", run.order.report.windows}};
}

std::string farthest_line(const FarthestRun& run) {
    const std::size_t kept = run.order.indices.size();
    std::string text = "order         farthest first, " +
                       counted(run.order.searches, "search", "searches") + ", " +
                       seconds_text(run.seconds) + '\n';
    if (kept < run.samples) {
        const double cover{run.order.cover};
        text += "kept          the first " + grouped(kept) + " of them" +
                (std::isfinite(cover) ? "; the others are within " + rounded(cover, 6) + " of these"
                                      : "; no path leads from these to some of the others") +
                '\n';
    }
    return text;
}

} // namespace geodisk::tools
