#include "geodisk/reports/neighbour_report.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

#include <geodisk/version.hpp>

#include "geodisk/reports/json.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "geodisk/reports/run_report.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

struct RowSizes {
    std::uint64_t least, most;
    double mean;
};

RowSizes sizes_of(const NeighbourTable& table) {
    RowSizes sizes{~std::uint64_t{0}, 0, 0};
    for (std::size_t i = 0; i + 1 < table.offsets.size(); ++i) {
        const std::uint64_t size = table.offsets[i + 1] - table.offsets[i];
        sizes.least = std::min(sizes.least, size);
        sizes.most = std::max(sizes.most, size);
    }
    sizes.mean =
        static_cast<double>(table.targets.size()) / static_cast<double>(table.offsets.size() - 1);
    return sizes;
}

/// Returns nothing where neighbours may be any distance away.
std::optional<double> largest_distance(const NeighbourJob& job) {
    if (!job.radii.empty()) {
        return *std::ranges::max_element(job.radii);
    }
    return job.within > 0 ? std::optional(job.within) : std::nullopt;
}

std::string within_text(const NeighbourJob& job) {
    const std::optional<double> distance = largest_distance(job);
    return !distance
               ? "any distance"
               : (job.radii.empty() ? "" : "up to ") + rounded(*distance, 6) + " in mesh units";
}

} // namespace

std::string NeighbourReport::json(double write_seconds) const {
    const RowSizes sizes = sizes_of(result.table);
    Json document{
        {"version", GEODISK_VERSION_STRING},
        {"mesh", mesh_json(mesh)},
        {"warnings", warnings_json(warnings)},
        {"sources",
         {{"kind", has_points ? "points" : "vertices"}, {"count", result.table.sources.size()}}},
        {"targets", targets},
        {"within", json_of(largest_distance(job))},
        {"nearest", job.nearest == 0 ? Json(nullptr) : Json(job.nearest)},
        {"pairs", result.table.targets.size()},
        {"per_source", {{"least", sizes.least}, {"mean", sizes.mean}, {"most", sizes.most}}},
        {"error", result.error},
        {"disks", result.done.run.disks},
        {"windows", result.done.run.windows},
        {"output", output}};
    return search_json(std::move(document), mesh, result.done, write_seconds);
}

std::string NeighbourReport::summary(double write_seconds) const {
    const RowSizes sizes = sizes_of(result.table);
    std::ostringstream out;
    out << mesh_lines("mesh", mesh) << "sources       "
        << (has_points ? counted(result.table.sources.size(), "point", "points")
                       : counted(result.table.sources.size(), "vertex", "vertices"))
        << '\n'
        << "neighbours    " << grouped(result.table.targets.size()) << " in all, "
        << grouped(sizes.least) << " to " << grouped(sizes.most) << " each, "
        << rounded(sizes.mean, 4) << " on average, among " << targets << '\n'
        << "within        " << within_text(job) << ", exact to " << rounded(result.error, 2) << '\n'
        << search_text(mesh, result.done, write_seconds, output, "searching");
    return out.str();
}

} // namespace geodisk::tools
