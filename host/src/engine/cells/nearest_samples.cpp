#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/nearest.hpp>

#include "engine/cells/cells_of.hpp"
#include "engine/cells/grid_points.hpp"
#include "engine/cells/near_lights.hpp"
#include "engine/cells/nearest_impl.hpp"
#include "engine/domain/existing.hpp"
#include "engine/neighbours/check_query.hpp"
#include "engine/run/runner_impl.hpp"
#include "mesh/extent.hpp"
#include "support/blocks.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

constexpr std::size_t kPointsPerPart = 4096;
// Fewer points or lights in a part of a face are looked at one by one.
constexpr std::size_t kFewPoints = 4, kFewLights = 8;
// Smaller parts of a face than any two points are apart.
constexpr std::uint32_t kSmallestPart = 24;

/// A point, and its number among those asked for.
struct NumberedPlace {
    FacePlace place;
    std::uint32_t number;
};

/// Finds the nearest samples of points of a face: in ever smaller parts of it, with the lights that
/// may be nearest there.
class FaceSearch {
  public:
    FaceSearch(const LitFaces& lit, const Closeness& closeness, std::span<NearestSample> found)
        : lit_(lit), near_(lit, closeness), found_(found) {}

    /// Finds those of points of one face, which it puts in another order.
    void search(std::span<NumberedPlace> points) {
        const std::uint32_t face = points.front().place.face;
        if (points.size() < kFewPoints) {
            look_at(points, lit_.lights_of(face));
            return;
        }
        search({face, 0, 0, 0, false}, points, near_.begin(face));
    }

  private:
    void search(const GapCell& cell, std::span<NumberedPlace> points, NearLights::Range lights);
    void look_at(std::span<const NumberedPlace> points, std::span<const std::uint32_t> lights);

    const LitFaces& lit_;
    NearLights near_;
    std::span<NearestSample> found_;
};

void FaceSearch::search(const GapCell& cell, std::span<NumberedPlace> points,
                        NearLights::Range lights) {
    if (points.size() < kFewPoints || lights.end - lights.first < kFewLights ||
        cell.level == kSmallestPart) {
        look_at(points, near_.at(lights));
        return;
    }
    const NearLights::View view = near_.look(cell.part(), lit_.target(cell), lights);
    const std::array<GapCell, 4> children = cell.children();
    for (std::size_t child = 0; child < children.size(); ++child) {
        const auto rest =
            std::partition(points.begin(), points.end(), [&](const NumberedPlace& point) {
                return cell.child_with(point.place.weights) == child;
            });
        const auto own = points.first(static_cast<std::size_t>(rest - points.begin()));
        if (!own.empty()) {
            search(children[child], own, view.lights);
            near_.pop_to(view.lights);
        }
        points = points.subspan(own.size());
    }
}

void FaceSearch::look_at(std::span<const NumberedPlace> points,
                         std::span<const std::uint32_t> lights) {
    for (const auto& [place, number] : points) {
        const auto [sample, distance] =
            near_.nearest_at(lit_.target(place.face, place.weights), lights);
        found_[number] = {sample, static_cast<float>(distance)};
    }
}

/// Returns where to look at each point, sorted by face.
Result<std::vector<NumberedPlace>> places_of(const PreparedMesh& mesh,
                                             std::span<const Sample> points) {
    const GridPoints grid(mesh, 24);
    std::vector<NumberedPlace> places;
    places.reserve(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (const std::string fault = fault_of(points[i], mesh); !fault.empty()) {
            return invalid("point " + std::to_string(i) + " " + fault);
        }
        places.push_back({grid.place(grid.point(points[i])), i});
    }
    std::ranges::sort(places, {},
                      [](const NumberedPlace& p) { return std::pair(p.place.face, p.number); });
    return places;
}

} // namespace

NearestSamples::NearestSamples(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
NearestSamples::NearestSamples(NearestSamples&&) noexcept = default;
NearestSamples& NearestSamples::operator=(NearestSamples&&) noexcept = default;
NearestSamples::~NearestSamples() = default;

Result<NearestSamples> NearestSamples::create(Runner& runner, const PreparedMesh& mesh,
                                              std::span<const Sample> samples,
                                              std::uint64_t max_records,
                                              const ProgressCallback& progress) noexcept {
    return guarded([&] {
        Runner::Impl& impl = Runner::Impl::of(runner);
        return impl.complete(Impl::find(impl, mesh, samples, max_records),
                             static_cast<std::uint32_t>(samples.size()), progress);
    });
}

Task<Result<NearestSamples>> NearestSamples::Impl::find(Runner::Impl& runner,
                                                        const PreparedMesh& mesh,
                                                        std::span<const Sample> samples,
                                                        std::uint64_t max_records,
                                                        WholeProgress whole) {
    CellParams params;
    params.max_records = max_records;
    const WholeProgress own = [whole = std::move(whole)](Progress now) {
        now.candidates /= 2; // The disks are all there is to compute.
        return whole ? whole(now) : now;
    };
    auto lit = co_await LitSamples::make(runner, mesh, samples, params, own);
    GEODISK_CO_TRY(lit);
    GEODISK_CO_TRY(check_range((*lit)->frame.unit, distance_bound(mesh)));
    auto impl = std::make_unique<Impl>();
    impl->mesh = &mesh;
    impl->threads = runner.options.threads;
    impl->report = (*lit)->lit->report();
    impl->error = (*lit)->distance_error();
    impl->samples = std::move(*lit);
    co_return NearestSamples(std::move(impl));
}

Result<std::vector<NearestSample>>
NearestSamples::of(std::span<const Sample> points) const noexcept {
    return guarded([&]() -> Result<std::vector<NearestSample>> {
        auto places = places_of(*impl_->mesh, points);
        GEODISK_TRY(places);
        std::vector<NearestSample> found(points.size());
        const LitCells& lit = *impl_->samples->lit;
        const std::size_t parts = (places->size() + kPointsPerPart - 1) / kPointsPerPart;
        for_parts(impl_->threads, parts, [&](std::size_t part) {
            FaceSearch search(lit.faces(), lit.closeness(), found);
            auto rest = std::span(*places).subspan(part * kPointsPerPart);
            rest = rest.first(std::min(rest.size(), kPointsPerPart));
            while (!rest.empty()) {
                const std::uint32_t face = rest.front().place.face;
                const auto end = std::ranges::find_if(
                    rest, [&](const NumberedPlace& p) { return p.place.face != face; });
                const auto own = rest.first(static_cast<std::size_t>(end - rest.begin()));
                search.search(own);
                rest = rest.subspan(own.size());
            }
        });
        const std::span<const std::uint32_t> numbers = impl_->samples->numbers;
        for (NearestSample& nearest : found) {
            if (nearest.sample != NearestSample::kNone) {
                nearest.sample = numbers[nearest.sample];
                nearest.distance *= static_cast<float>(impl_->samples->frame.unit);
            }
        }
        return found;
    });
}

Result<SurfaceCells> NearestSamples::cells(const ProgressCallback& progress) const noexcept {
    return guarded(
        [&] { return cells_of(*impl_->mesh, *impl_->samples, impl_->threads, progress); });
}

double NearestSamples::error() const noexcept {
    return impl_->error;
}

const RunReport& NearestSamples::report() const noexcept {
    return impl_->report;
}

} // namespace geodisk
