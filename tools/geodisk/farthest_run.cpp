#include "geodisk/farthest_run.hpp"

#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "files/samples/sample_columns.hpp"
#include "geodisk/opened_device.hpp"
#include "geodisk/reports/json.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/stopwatch.hpp"

namespace geodisk::tools {
namespace {

/// Returns a callback that counts disks by their area, which falls as samples are chosen.
ProgressCallback by_area(ProgressCallback shown) {
    return [shown = std::move(shown)](const Progress& state) {
        Progress weighed = state;
        const double part = std::log1p(static_cast<double>(state.decided)) /
                            std::log1p(static_cast<double>(state.candidates));
        weighed.decided = static_cast<std::uint32_t>(part * state.candidates);
        return shown(weighed);
    };
}

/// Returns a distance, or null for one that no path has.
Json distance_json(double distance) {
    return std::isfinite(distance) ? Json(distance) : Json(nullptr);
}

} // namespace

std::vector<SampleField> FarthestRun::columns() const {
    const auto column = [](std::string_view name, const auto& values) {
        return SampleField{
            std::string(name), {std::string(name)}, false, false, {values.begin(), values.end()}};
    };
    std::vector<SampleField> fields{column(kCoverColumn, order.distances),
                                    column(kRowColumn, order.indices)};
    fields.front().is_float = true;
    fields.back().is_whole = true;
    return fields;
}

FarthestRun order_farthest(const MeshInput& mesh, std::span<const SampleRow> rows,
                           const FarthestParams& params, RunDevice& device,
                           ProgressLine& progress) {
    const std::string few = "there are only " + counted(rows.size(), "sample", "samples");
    if (params.count > rows.size()) {
        fail_usage("--keep: " + few + ", fewer than " + grouped(params.count));
    }
    if (params.start != 0 && params.start >= rows.size()) {
        fail_usage("--start: " + few + ", counted from 0, so none is number " +
                   grouped(params.start));
    }
    if (params.existing > rows.size()) {
        fail_usage("--first: " + few + ", fewer than " + grouped(params.existing));
    }
    if (params.count != 0 && params.count < params.existing) {
        fail_usage("--keep: " + grouped(params.existing) +
                   " samples come first as they are, more than " + grouped(params.count));
    }
    FarthestRun run;
    run.samples = rows.size();
    if (rows.empty()) {
        return run;
    }
    device.open(progress);
    progress.begin_stage("putting samples in order");
    const Stopwatch watch;
    auto found = farthest_order(device.runner(), mesh.prepared, samples_of(rows), params,
                                by_area(search_progress(progress, "in order")));
    progress.clear();
    check_interrupted();
    if (!found) {
        device.check(found.error());
    }
    run.order = take(std::move(found));
    run.seconds = watch.seconds();
    check_validation(device.context());
    return run;
}

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
