#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "ending_all.hpp"
#include "geodisk/mpi.hpp"
#include "mesh/radius_pieces.hpp"
#include "mpi_exchange.hpp"
#include "parts/part.hpp"
#include "parts/ranges/ranged_surface.hpp"
#include "parts/ranges/talk.hpp"
#include "parts/sample_parts.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Place of a vertex, and its radius.
struct Corner {
    double place[3];
    float factor, packing; ///< Values of VertexRadii, or 0.
};

/// A face by its corners, as processes send it.
struct FaceCorners {
    std::uint32_t face;
    Corner corners[3];
};

/// Returns own faces by their corners.
std::vector<FaceCorners> corners_of(std::span<const std::uint32_t> own, const FacePlaces& places) {
    std::vector<FaceCorners> faces(own.size());
    const auto value = [](const std::vector<float>& values, std::size_t vertex) {
        return values.empty() ? 0.0f : values[vertex];
    };
    for (std::size_t i = 0; i < own.size(); ++i) {
        faces[i].face = own[i];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t vertex = places.triangles[3 * i + k];
            Corner& corner = faces[i].corners[k];
            std::copy_n(&places.positions[3 * vertex], 3, corner.place);
            corner.factor = value(places.radii.factors, vertex);
            corner.packing = value(places.radii.packing, vertex);
        }
    }
    return faces;
}

/// Returns the places of faces, and the radii if they vary.
PlacedFaces placed(std::span<const FaceCorners> faces, bool do_radii_vary) {
    PlacedFaces placed;
    VertexRadii radii;
    for (const FaceCorners& face : faces) {
        for (const Corner& corner : face.corners) {
            placed.triangles.push_back(static_cast<std::uint32_t>(placed.triangles.size()));
            placed.positions.insert(placed.positions.end(), corner.place, corner.place + 3);
            if (corner.factor > 0) {
                radii.factors.push_back(corner.factor);
            }
            if (corner.packing > 0) {
                radii.packing.push_back(corner.packing);
            }
        }
    }
    if (do_radii_vary) {
        placed.radii = RadiusPieces::factors_on(placed.triangles, radii);
    }
    return placed;
}

/// Returns the places of own faces among some, at one part those of all.
Result<PlacedFaces> places_at(Exchange& exchange, const RangedSurface& surface,
                              std::span<const std::uint32_t> wanted, std::uint32_t at) {
    std::vector<std::uint32_t> own;
    for (const WholeFace& face : surface.faces()) {
        if (std::ranges::binary_search(wanted, face.face)) {
            own.push_back(face.face);
        }
    }
    const auto places = surface.places(exchange, own);
    GEODISK_TRY(places);
    return caught([&]() -> Result<PlacedFaces> {
        ByProcess<FaceCorners> told(exchange.size());
        told[at] = corners_of(own, *places);
        std::vector<FaceCorners> all;
        for (const auto& some : Talk(exchange).all_to_all(std::move(told))) {
            all.insert(all.end(), some.begin(), some.end());
        }
        std::ranges::sort(all, {}, &FaceCorners::face);
        return placed(all, surface.radii() != nullptr);
    });
}

} // namespace

struct SharedSurface::Impl {
    /// A part of this process.
    struct Lane {
        std::unique_ptr<MpiExchange> exchange;
        std::optional<RangedSurface> surface;
    };

    /// Does work for each part, on a thread of its own that mostly waits. Returns the result of the
    /// first one.
    template <class Work>
    std::invoke_result_t<Work, Lane&> all(const Work& work) noexcept {
        return ending_all(options, [&]() -> std::invoke_result_t<Work, Lane&> {
            const auto work_at = [&](Lane& lane) {
                return ending_all(options, [&] { return work(lane); });
            };
            std::vector<std::jthread> threads;
            for (std::size_t i = 1; i < lanes.size(); ++i) {
                threads.emplace_back([&, i] { (void)work_at(lanes[i]); });
            }
            return work_at(lanes.front());
        });
    }
    const RangedSurface& surface() const { return *lanes.front().surface; }

    ProcessOptions options;
    std::vector<Lane> lanes;
};

SharedSurface::SharedSurface(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
SharedSurface::SharedSurface(SharedSurface&&) noexcept = default;
SharedSurface& SharedSurface::operator=(SharedSurface&&) noexcept = default;
SharedSurface::~SharedSurface() = default;

Result<SharedSurface> Processes::read_ranges(std::uint32_t parts,
                                             const SharedSurface::ReadRange& read) const noexcept {
    return ending_all(options_, [&]() -> Result<SharedSurface> {
        auto exchanges = MpiExchange::create_lanes(communicator_, parts, options_.goes_on);
        GEODISK_TRY(exchanges);
        auto impl = std::make_unique<SharedSurface::Impl>();
        impl->options = options_;
        for (auto& exchange : *exchanges) {
            impl->lanes.push_back({std::move(exchange), std::nullopt});
        }
        const auto made = impl->all([&](SharedSurface::Impl::Lane& lane) -> Result<Done> {
            auto range = read(*lane.exchange);
            GEODISK_TRY(range);
            auto surface = RangedSurface::create(*lane.exchange, std::move(*range));
            GEODISK_TRY(surface);
            lane.surface = std::move(*surface);
            return Done{};
        });
        GEODISK_TRY(made);
        return SharedSurface(std::move(impl));
    });
}

const RangedStatistics& SharedSurface::statistics() const noexcept {
    return impl_->surface().statistics();
}

const PreparedMesh& SharedSurface::outline() const noexcept {
    return impl_->surface().outline();
}

const RadiusField* SharedSurface::radii() const noexcept {
    return impl_->surface().radii();
}

Result<JobFrame> SharedSurface::frame(const SampleParams& params) const noexcept {
    return guarded([&] { return impl_->surface().frame(params); });
}

Result<SharedSamples> SharedSurface::sample(Runner& runner, const SampleParams& params,
                                            const Checkpoints* checkpoints,
                                            const ProgressCallback& progress) noexcept {
    return impl_->all([&](Impl::Lane& lane) {
        return sample_ranges(*lane.exchange, runner, *lane.surface, params,
                             lane.exchange->rank() == 0 ? checkpoints : nullptr, progress);
    });
}

Result<PlacedFaces> SharedSurface::places(std::span<const std::uint32_t> faces,
                                          std::uint32_t process) noexcept {
    const auto at = static_cast<std::uint32_t>(process * impl_->lanes.size());
    return impl_->all(
        [&](Impl::Lane& lane) { return places_at(*lane.exchange, *lane.surface, faces, at); });
}

} // namespace geodisk
