#include "ranged_parts.hpp"

#include <algorithm>
#include <exception>
#include <thread>
#include <utility>

#include "parts/ranges/talk.hpp"

namespace geodisk::tools {
namespace {

// With the buffers of the device, a part of so many faces takes about 300 MB, and it fits the
// bindings of all devices.
constexpr std::uint64_t kFacesOfPart = std::uint64_t{1} << 20;

struct Corner {
    double place[3];
    float factor, packing; ///< Values of VertexRadii, or 0.
};
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

/// Returns the places of faces; radii without spreads.
FacePlaces places_of(std::span<const FaceCorners> faces) {
    FacePlaces places;
    for (const FaceCorners& face : faces) {
        for (const Corner& corner : face.corners) {
            places.triangles.push_back(static_cast<std::uint32_t>(places.triangles.size()));
            places.positions.insert(places.positions.end(), corner.place, corner.place + 3);
            if (corner.factor > 0) {
                places.radii.factors.push_back(corner.factor);
            }
            if (corner.packing > 0) {
                places.radii.packing.push_back(corner.packing);
            }
        }
    }
    return places;
}

/// Returns the places of own faces among some, at one part those of all.
Result<FacePlaces> places_at(Exchange& exchange, const RangedSurface& surface,
                             std::span<const std::uint32_t> wanted, std::uint32_t at) {
    std::vector<std::uint32_t> own;
    for (const WholeFace& face : surface.faces()) {
        if (std::ranges::binary_search(wanted, face.face)) {
            own.push_back(face.face);
        }
    }
    const auto places = surface.places(exchange, own);
    if (!places) {
        return places.error();
    }
    return caught([&]() -> Result<FacePlaces> {
        ByProcess<FaceCorners> told(exchange.size());
        told[at] = corners_of(own, *places);
        std::vector<FaceCorners> all;
        for (const auto& some : Talk(exchange).all_to_all(std::move(told))) {
            all.insert(all.end(), some.begin(), some.end());
        }
        std::ranges::sort(all, {}, &FaceCorners::face);
        return places_of(all);
    });
}

} // namespace

std::uint32_t parts_of_process(std::uint64_t faces, std::uint32_t processes, std::uint32_t asked) {
    int level = MPI_THREAD_SINGLE;
    MPI_Query_thread(&level);
    if (level < MPI_THREAD_SERIALIZED) {
        return 1;
    }
    const std::uint64_t own = faces / processes;
    const std::uint64_t wanted = asked != 0 ? asked : (own + kFacesOfPart - 1) / kFacesOfPart;
    const std::uint64_t most = std::min<std::uint64_t>(own, MpiExchange::kMaxLanes);
    return static_cast<std::uint32_t>(std::max<std::uint64_t>(1, std::min(wanted, most)));
}

template <class Work>
auto RangedParts::all(const Work& work) {
    std::vector<std::optional<decltype(work(lanes_.front()))>> results(lanes_.size());
    const auto work_at = [&](std::size_t i) {
        try {
            results[i].emplace(work(lanes_[i]));
        } catch (...) {
            fails_(std::current_exception());
        }
    };
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = 1; i < lanes_.size(); ++i) {
            threads.emplace_back(work_at, i);
        }
        work_at(0);
    }
    return std::move(*results.front());
}

Result<RangedParts> RangedParts::read(MPI_Comm communicator, const MpiExchange::GoesOn& goes_on,
                                      Fails fails, std::uint32_t parts, const Path& path,
                                      const RangeWants& wants) {
    auto exchanges = MpiExchange::create_lanes(communicator, parts, goes_on);
    if (!exchanges) {
        return exchanges.error();
    }
    RangedParts made(std::move(fails));
    for (auto& exchange : *exchanges) {
        made.lanes_.push_back({std::move(exchange), std::nullopt});
    }
    const auto well = made.all([&](Lane& lane) -> Result<Done> {
        auto range = read_ply_range(*lane.exchange, path, wants);
        if (!range) {
            return range.error();
        }
        auto surface = RangedSurface::create(*lane.exchange, std::move(*range));
        if (!surface) {
            return surface.error();
        }
        lane.surface = std::move(*surface);
        return Done{};
    });
    return well ? Result<RangedParts>(std::move(made)) : well.error();
}

Result<SharedSamples> RangedParts::sample(Runner& runner, const SampleParams& params,
                                          const Checkpoints* checkpoints,
                                          const ProgressCallback& progress) {
    return all([&](Lane& lane) {
        return sample_ranges(*lane.exchange, runner, *lane.surface, params,
                             lane.exchange->rank() == 0 ? checkpoints : nullptr, progress);
    });
}

Result<FacePlaces> RangedParts::places(std::span<const std::uint32_t> faces,
                                       std::uint32_t process) {
    const auto at = static_cast<std::uint32_t>(process * lanes_.size());
    return all([&](Lane& lane) { return places_at(*lane.exchange, *lane.surface, faces, at); });
}

} // namespace geodisk::tools
