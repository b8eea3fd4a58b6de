#include <geodisk/frame_neighbours.hpp>

#include <atomic>
#include <memory>
#include <utility>

#include <geodisk/geodisk.h>

#include "c/c_call.hpp"
#include "c/c_device.hpp"
#include "c/c_frames.hpp"
#include "c/c_handles.hpp"
#include "c/c_neighbours.hpp"
#include "c/c_sampler.hpp"
#include "support/try.hpp"

struct geodisk_frame_neighbours {
    std::shared_ptr<const geodisk::c::Device> device;
    std::shared_ptr<const geodisk::c::NeighbourSearch> search;
    geodisk::FrameNeighbours recorded;
    std::atomic<bool> is_held = false; ///< True while a call uses it.
};

namespace geodisk::c {
namespace {

constexpr const char* kSearchName = "the search";

FrameNeighbourOptions options_of(const geodisk_frame_neighbour_options& given) {
    auto options = frame_options_of<FrameNeighbourOptions>(given);
    set_if_given(options.record_bytes, given.record_bytes);
    return options;
}

} // namespace
} // namespace geodisk::c

using namespace geodisk;
using namespace geodisk::c;

extern "C" {

geodisk_status geodisk_frame_neighbours_create(const geodisk_device* device,
                                               const geodisk_mesh* mesh,
                                               const geodisk_neighbour_params* params,
                                               const geodisk_frame_neighbour_options* options,
                                               geodisk_frame_neighbours** frames,
                                               geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (device == nullptr || mesh == nullptr || frames == nullptr) {
            return wrong("device, mesh or frames is NULL");
        }
        const auto asked = taken(params, "params");
        GEODISK_TRY(asked);
        const auto wanted = taken_if_any(options, "options");
        GEODISK_TRY(wanted);
        const auto search = search_for(*mesh, *asked);
        GEODISK_TRY(search);
        auto sampler = device->shared->sampler();
        GEODISK_TRY(sampler);
        auto made = FrameNeighbours::create(std::move(*sampler), (*search)->mesh->prepared,
                                            (*search)->query, options_of(*wanted));
        GEODISK_TRY(made);
        *frames = new geodisk_frame_neighbours{device->shared, *search, std::move(*made)};
        return Done{};
    });
}

geodisk_status geodisk_frame_neighbours_record(geodisk_frame_neighbours* frames,
                                               void* command_buffer, int32_t* is_complete,
                                               geodisk_error* error) {
    return with_frames(frames, kSearchName, error,
                       [&](geodisk_frame_neighbours& own) -> Result<Done> {
                           return record_frame(own.recorded, command_buffer, is_complete);
                       });
}

geodisk_status geodisk_frame_neighbours_wait(geodisk_frame_neighbours* frames,
                                             geodisk_sampler* sampler, geodisk_error* error) {
    return with_frames(
        frames, kSearchName, error, [&](geodisk_frame_neighbours& own) -> Result<Done> {
            if (sampler == nullptr) {
                return wrong("sampler is NULL");
            }
            SamplerState& state = *sampler->shared;
            return hold(state.is_held, "the sampler", [&]() -> Result<Done> {
                if (state.is_busy()) {
                    return run_in_progress();
                }
                state.is_cancelled = false;
                return own.recorded.find_and_wait(state.runner, state.callback(nullptr, nullptr));
            });
        });
}

geodisk_status geodisk_frame_neighbours_describe(const geodisk_frame_neighbours* frames,
                                                 geodisk_frame_neighbour_lists* lists,
                                                 geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (frames == nullptr) {
            return wrong("frames is NULL");
        }
        const FrameNeighbourLists found = frames->recorded.lists();
        geodisk_frame_neighbour_lists told{};
        told.buffer = number_of(found.buffer);
        told.offsets_offset = found.offsets_offset;
        told.indices_offset = found.indices_offset;
        told.distances_offset = found.distances_offset;
        told.device_bytes = frames->recorded.device_bytes();
        told.source_count = found.sources;
        told.capacity = found.capacity;
        told.ready = found.ready;
        told.pair_count = found.pairs;
        told.error = found.error;
        told.is_complete = found.is_complete ? 1 : 0;
        return give(lists, "lists", told);
    });
}

void geodisk_frame_neighbours_release(geodisk_frame_neighbours* frames) {
    delete frames;
}

} // extern "C"
