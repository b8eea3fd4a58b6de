#include "engine/cells/lit_samples.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/cells/grid_points.hpp"
#include "engine/domain/existing.hpp"
#include "engine/domain/face_mask.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// Disks of even samples cover the surface, with this radius in parts of the square root of the area
// per sample.
constexpr double kFirstRadius = 0.85;
// No edge may be too long for it.
constexpr double kLongestEdge = 1000;

Result<Done> check_samples(const PreparedMesh& mesh, std::span<const Sample> samples) {
    if (samples.empty()) {
        return invalid("there is no sample");
    }
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (const std::string fault = fault_of(samples[i], mesh); !fault.empty()) {
            return invalid("sample " + std::to_string(i) + " " + fault);
        }
    }
    return Done{};
}

/// Returns the first of all samples at each place.
std::vector<std::uint32_t> unlike_samples(const PreparedMesh& mesh,
                                          std::span<const Sample> samples) {
    const GridPoints grid(mesh, 24);
    std::vector<std::pair<GridPoint, std::uint32_t>> places;
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
        places.emplace_back(grid.point(samples[i]), i);
    }
    std::ranges::sort(places);
    std::vector<std::uint32_t> first;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (i == 0 || places[i].first != places[i - 1].first) {
            first.push_back(places[i].second);
        }
    }
    std::ranges::sort(first);
    return first;
}

} // namespace

Task<Result<std::unique_ptr<LitSamples>>> LitSamples::make(Runner::Impl& runner,
                                                           const PreparedMesh& mesh,
                                                           std::span<const Sample> samples,
                                                           CellParams params, WholeProgress whole) {
    GEODISK_CO_TRY(check_samples(mesh, samples));
    GEODISK_CO_TRY(check_mask_size(mesh, params.face_mask));
    if (!params.face_mask.empty() && std::ranges::count(params.face_mask, 0) ==
                                         static_cast<std::ptrdiff_t>(params.face_mask.size())) {
        co_return invalid("the face mask leaves out all faces, so no cell has an area");
    }
    auto made = std::make_unique<LitSamples>();
    made->params = params;
    made->all = samples.size();
    made->numbers = unlike_samples(mesh, samples);
    for (const std::uint32_t sample : made->numbers) {
        made->samples.push_back(samples[sample]);
    }
    const MeshStatistics& statistics = mesh.statistics();
    const double each = statistics.area / static_cast<double>(made->samples.size());
    made->job.min_distance =
        std::max(kFirstRadius * std::sqrt(each), statistics.longest_edge / kLongestEdge);
    const auto frame = frame_of_disks(mesh, made->job);
    GEODISK_CO_TRY(frame);
    made->frame = *frame;
    made->lit = std::make_unique<LitCells>(runner, mesh, made->samples, made->job, made->frame,
                                           made->params);
    GEODISK_CO_TRY(co_await made->lit->light(std::move(whole)));
    co_return made;
}

double LitSamples::distance_error() const {
    return lit->closeness().error * std::max(1.0, 2 * lit->largest_radius()) * frame.unit;
}

} // namespace geodisk
