#include <cstddef>
#include <memory>
#include <utility>

#include <geodisk/placement.hpp>

#include "c/c_job.hpp"
#include "samples.h"
#include "support/try.hpp"

struct geodisk_placement {
    std::shared_ptr<const geodisk::c::Device> device;
    std::shared_ptr<const geodisk::Sampler> sampler;
    geodisk::Placement recorded;
};

namespace geodisk::c {
namespace {

static_assert(sizeof(geodisk_placed_record) == sizeof(gpu::PlacedRec) &&
              offsetof(geodisk_placed_record, radius) == offsetof(gpu::PlacedRec, radius) &&
              offsetof(geodisk_placed_record, normal) == offsetof(gpu::PlacedRec, normal_x) &&
              offsetof(geodisk_placed_record, face) == offsetof(gpu::PlacedRec, face) &&
              offsetof(geodisk_placed_record, weight1) == offsetof(gpu::PlacedRec, weight1) &&
              offsetof(geodisk_placed_record, part) == offsetof(gpu::PlacedRec, part) &&
              offsetof(geodisk_placed_record, order) == offsetof(gpu::PlacedRec, order));

Result<PlacementSource> source_of(const geodisk_placement_params& given) {
    if (given.index_type != 0 && given.index_type != GEODISK_UINT32 &&
        given.index_type != GEODISK_UINT16) {
        return wrong("params->index_type is neither GEODISK_UINT32 nor GEODISK_UINT16");
    }
    PlacementSource source;
    source.vertices = range_of(given.vertices);
    source.stride = given.vertex_stride != 0 ? given.vertex_stride : 12;
    source.position = given.position_offset;
    if (given.has_normals != 0) {
        source.normal = given.normal_offset;
    }
    source.indices = range_of(given.indices);
    source.index_bytes = given.index_type == GEODISK_UINT16 ? 2 : 4;
    return source;
}

PlacementTarget target_of(const geodisk_placement_params& given) {
    PlacementTarget target;
    target.placed = range_of(given.placed);
    target.arguments = range_of(given.arguments);
    target.vertices_each = given.vertices_each != 0 ? given.vertices_each : 1;
    return target;
}

} // namespace
} // namespace geodisk::c

using namespace geodisk;
using namespace geodisk::c;

extern "C" {

geodisk_status geodisk_placement_create(geodisk_job* job, const geodisk_placement_params* params,
                                        geodisk_placement** placement, geodisk_error* error) {
    return with_job(job, error, [&](geodisk_job& own) -> Result<Done> {
        if (placement == nullptr) {
            return wrong("placement is NULL");
        }
        const auto given = taken(params, "params");
        GEODISK_TRY(given);
        if (!own.is_bound()) {
            return needs_buffers();
        }
        const auto source = source_of(*given);
        GEODISK_TRY(source);
        auto made = Placement::create(*own.sampler, *own.domain->domain, *own.recorded, *source,
                                      target_of(*given));
        GEODISK_TRY(made);
        *placement = new geodisk_placement{own.device, own.sampler, std::move(*made)};
        return Done{};
    });
}

geodisk_status geodisk_placement_record(const geodisk_placement* placement, geodisk_job* job,
                                        void* command_buffer, geodisk_error* error) {
    return with_job(job, error, [&](geodisk_job& own) -> Result<Done> {
        if (placement == nullptr || command_buffer == nullptr) {
            return wrong("placement or command_buffer is NULL");
        }
        if (!own.is_bound()) {
            return needs_buffers();
        }
        return placement->recorded.record(static_cast<VkCommandBuffer>(command_buffer),
                                          *own.recorded);
    });
}

void geodisk_placement_release(geodisk_placement* placement) {
    delete placement;
}

} // extern "C"
