#include "geodisk/farthest_run.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "files/samples/sample_columns.hpp"
#include "geodisk/opened_device.hpp"
#include "geodisk/search_progress.hpp"
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

} // namespace

SampleField FarthestRun::cover() const {
    SampleField field{std::string(kCoverColumn),
                      {std::string(kCoverColumn)},
                      false,
                      false,
                      {order.distances.begin(), order.distances.end()}};
    field.is_float = true;
    return field;
}

FarthestRun order_farthest(const MeshInput& mesh, std::span<const SampleRow> rows,
                           std::uint32_t keep, RunDevice& device, ProgressLine& progress) {
    if (keep > rows.size()) {
        fail_usage("--keep: there are only " + counted(rows.size(), "sample", "samples") +
                   ", fewer than " + grouped(keep));
    }
    FarthestRun run;
    run.samples = rows.size();
    if (rows.empty()) {
        return run;
    }
    std::vector<Sample> samples;
    samples.reserve(rows.size());
    for (const SampleRow& row : rows) {
        samples.push_back(sample_of(row));
    }
    device.open(progress);
    progress.begin_stage("putting samples in order");
    const Stopwatch watch;
    auto found = farthest_order(device.runner(), mesh.prepared, samples, keep,
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

} // namespace geodisk::tools
