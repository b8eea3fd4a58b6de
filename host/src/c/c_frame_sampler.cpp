#include <geodisk/frame_sampler.hpp>

#include <atomic>
#include <memory>
#include <utility>
#include <vector>

#include <geodisk/geodisk.h>

#include "c/c_call.hpp"
#include "c/c_device.hpp"
#include "c/c_domain.hpp"
#include "c/c_frames.hpp"
#include "c/c_handles.hpp"
#include "c/c_request.hpp"
#include "c/c_sampler.hpp"
#include "support/try.hpp"

struct geodisk_frame_sampler {
    std::shared_ptr<const geodisk::c::Device> device;
    std::shared_ptr<const void> sampled; ///< Its domain, or its requests.
    geodisk::FrameSampler recorded;
    std::atomic<bool> is_held = false; ///< True while a call uses it.
};

namespace geodisk::c {
namespace {

constexpr const char* kSamplerName = "the frame sampler";

FrameSamplerOptions options_of(const geodisk_frame_options& given) {
    auto options = frame_options_of<FrameSamplerOptions>(given);
    set_if_given(options.vertices_each, given.vertices_each);
    return options;
}

/// Makes a frame sampler by `make(sampler, options)`, which keeps what it samples.
template <class Make>
Result<Done> create_frames(const geodisk_device& device, const geodisk_frame_options* options,
                           std::shared_ptr<const void> sampled, geodisk_frame_sampler*& frames,
                           const Make& make) {
    const auto wanted = taken_if_any(options, "options");
    GEODISK_TRY(wanted);
    auto sampler = device.shared->sampler();
    GEODISK_TRY(sampler);
    auto made = make(std::move(*sampler), options_of(*wanted));
    GEODISK_TRY(made);
    frames = new geodisk_frame_sampler{device.shared, std::move(sampled), std::move(*made)};
    return Done{};
}

} // namespace
} // namespace geodisk::c

using namespace geodisk;
using namespace geodisk::c;

extern "C" {

geodisk_status geodisk_frame_sampler_create_requests(
    const geodisk_device* device, const geodisk_mesh_request* requests, size_t count,
    const geodisk_frame_options* options, geodisk_frame_sampler** frames, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (device == nullptr || frames == nullptr) {
            return wrong("device or frames is NULL");
        }
        auto state = requests_of(requests, count);
        GEODISK_TRY(state);
        return create_frames(*device, options, *state, *frames, [&](auto sampler, const auto& own) {
            return FrameSampler::create(std::move(sampler), (*state)->on_meshes(), own);
        });
    });
}

geodisk_status geodisk_frame_sampler_create(const geodisk_device* device,
                                            const geodisk_domain* domain,
                                            const geodisk_frame_options* options,
                                            geodisk_frame_sampler** frames, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (device == nullptr || domain == nullptr || frames == nullptr) {
            return wrong("device, domain or frames is NULL");
        }
        std::vector<MeshView> meshes;
        for (const Part& part : domain->shared->parts) {
            meshes.push_back(part.mesh->view());
        }
        return create_frames(*device, options, domain->shared, *frames,
                             [&](auto sampler, const auto& own) {
                                 return FrameSampler::create(std::move(sampler),
                                                             *domain->shared->domain, meshes, own);
                             });
    });
}

geodisk_status geodisk_frame_sampler_record(geodisk_frame_sampler* frames, void* command_buffer,
                                            int32_t* is_complete, geodisk_error* error) {
    return with_frames(frames, kSamplerName, error,
                       [&](geodisk_frame_sampler& own) -> Result<Done> {
                           return record_frame(own.recorded, command_buffer, is_complete);
                       });
}

geodisk_status geodisk_frame_sampler_wait(geodisk_frame_sampler* frames, geodisk_sampler* sampler,
                                          geodisk_error* error) {
    return with_frames(
        frames, kSamplerName, error, [&](geodisk_frame_sampler& own) -> Result<Done> {
            if (sampler == nullptr) {
                return wrong("sampler is NULL");
            }
            const auto state = sampler->shared;
            return hold(state->is_held, "the sampler", [&]() -> Result<Done> {
                state->is_cancelled = false;
                const auto go_on = [&](const Progress&) { return !state->is_cancelled; };
                return own.recorded.sample_and_wait(state->runner, go_on);
            });
        });
}

geodisk_status geodisk_frame_sampler_describe(const geodisk_frame_sampler* frames,
                                              geodisk_frame_samples* samples,
                                              geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (frames == nullptr) {
            return wrong("frames is NULL");
        }
        const FrameSamples found = frames->recorded.samples();
        geodisk_frame_samples told{};
        told.buffer = number_of(found.buffer);
        told.placed_offset = found.placed_offset;
        told.arguments_offset = found.arguments_offset;
        told.device_bytes = frames->recorded.device_bytes();
        told.capacity = found.capacity;
        told.ready = found.ready;
        told.is_complete = found.is_complete ? 1 : 0;
        return give(samples, "samples", told);
    });
}

geodisk_status geodisk_frame_sampler_set_seed(geodisk_frame_sampler* frames, uint64_t seed,
                                              geodisk_error* error) {
    return with_frames(frames, kSamplerName, error,
                       [&](geodisk_frame_sampler& own) -> Result<Done> {
                           own.recorded.set_seed(seed);
                           return Done{};
                       });
}

void geodisk_frame_sampler_release(geodisk_frame_sampler* frames) {
    delete frames;
}

} // extern "C"
