#include <algorithm>

#include <geodisk/farthest.hpp>

#include "c/c_call.hpp"
#include "c/c_mesh.hpp"
#include "c/c_sampler.hpp"
#include "support/try.hpp"

namespace geodisk::c {
namespace {

geodisk_farthest_info info_of(const FarthestOrder& found) {
    geodisk_farthest_info info{};
    info.cover = double{found.cover};
    info.error = found.error;
    info.searches = found.searches;
    return info;
}

} // namespace
} // namespace geodisk::c

using namespace geodisk;
using namespace geodisk::c;

extern "C" {

geodisk_status geodisk_farthest_order(geodisk_sampler* sampler, const geodisk_mesh* mesh,
                                      const geodisk_farthest_params* params,
                                      geodisk_progress_fn progress, void* user, uint32_t* order,
                                      float* distances, geodisk_farthest_info* info,
                                      geodisk_error* error) {
    return with_sampler(sampler, error, [&](SamplerState& state) -> Result<Done> {
        if (mesh == nullptr || order == nullptr) {
            return wrong("mesh or order is NULL");
        }
        const auto wanted = taken(params, "params");
        GEODISK_TRY(wanted);
        if (wanted->samples == nullptr && wanted->sample_count != 0) {
            return wrong("params->samples is NULL");
        }
        if (info != nullptr) { // Before the work.
            GEODISK_TRY(give(info, "info", geodisk_farthest_info{}));
        }
        const auto found = search(state, progress, user, [&](const ProgressCallback& heard) {
            return farthest_order(state.runner, mesh->shared->prepared,
                                  samples_of(wanted->samples, wanted->sample_count),
                                  {wanted->count, wanted->start, wanted->existing}, heard);
        });
        GEODISK_TRY(found);
        std::ranges::copy(found->indices, order);
        if (distances != nullptr) {
            std::ranges::copy(found->distances, distances);
        }
        return info == nullptr ? Result<Done>(Done{}) : give(info, "info", info_of(*found));
    });
}

} // extern "C"
