#include "c/c_job.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <utility>

#include "c/c_handles.hpp"
#include "records.h"
#include "support/try.hpp"

namespace geodisk::c {
namespace {

Result<BufferRole> role_of(std::uint32_t buffer) {
    if (buffer >= kBufferRoles) {
        return wrong("buffer is " + std::to_string(buffer) + ", but there are " +
                     std::to_string(kBufferRoles));
    }
    return static_cast<BufferRole>(buffer);
}

} // namespace
} // namespace geodisk::c

using namespace geodisk;
using namespace geodisk::c;

extern "C" {

geodisk_status geodisk_job_create(const geodisk_device* device, const geodisk_domain* domain,
                                  const geodisk_job_options* options, geodisk_job** job,
                                  geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (device == nullptr || domain == nullptr || job == nullptr) {
            return wrong("device, domain or job is NULL");
        }
        const auto wanted = taken_if_any(options, "options");
        GEODISK_TRY(wanted);
        auto made = make_job(*device, *domain, *wanted);
        GEODISK_TRY(made);
        *job = made->release();
        return Done{};
    });
}

geodisk_status geodisk_job_need(geodisk_job* job, uint32_t buffer, geodisk_buffer_need* need,
                                geodisk_error* error) {
    return with_job(job, error, [&](geodisk_job& own) -> Result<Done> {
        const auto role = role_of(buffer);
        GEODISK_TRY(role);
        geodisk_buffer_need found{};
        found.bytes = own.needed[buffer];
        found.upload_bytes = upload_bytes(own, *role);
        found.read_bytes = *role == BufferRole::control ? sizeof(gpu::ControlRec) : 0;
        return give(need, "need", found);
    });
}

geodisk_status geodisk_job_lay_out(geodisk_job* job, uint64_t buffer, uint64_t offset,
                                   geodisk_buffer_range* ranges, uint64_t* bytes,
                                   geodisk_error* error) {
    return with_job(job, error, [&](geodisk_job& own) -> Result<Done> {
        if (ranges == nullptr || bytes == nullptr) {
            return wrong("ranges or bytes is NULL");
        }
        WorkspaceNeeds needs;
        std::copy(own.needed.begin(), own.needed.end(), needs.bytes.begin());
        const WorkspaceLayout layout = own.sampler->lay_out(needs);
        if (offset % layout.alignment != 0) {
            return wrong("offset is " + std::to_string(offset) + ", no multiple of the device's " +
                         std::to_string(layout.alignment));
        }
        const Workspace workspace = layout.in(handle_of<VkBuffer>(buffer), offset);
        std::transform(workspace.begin(), workspace.end(), ranges, [](const BufferRange& range) {
            return geodisk_buffer_range{number_of(range.buffer), range.offset, range.size};
        });
        *bytes = layout.bytes;
        return Done{};
    });
}

geodisk_status geodisk_job_bind(geodisk_job* job, const geodisk_buffer_range* ranges,
                                geodisk_error* error) {
    return with_job(job, error, [&](geodisk_job& own) {
        return ranges != nullptr ? bind(own, ranges) : wrong("ranges is NULL");
    });
}

geodisk_status geodisk_job_upload(geodisk_job* job, uint32_t buffer, void* data, size_t bytes,
                                  geodisk_error* error) {
    return with_job(job, error, [&](geodisk_job& own) -> Result<Done> {
        const auto role = role_of(buffer);
        GEODISK_TRY(role);
        if (data == nullptr) {
            return wrong("data is NULL");
        }
        auto written = write_upload(own, *role, {static_cast<std::byte*>(data), bytes});
        own.uploaded[buffer] = own.uploaded[buffer] || static_cast<bool>(written);
        return written;
    });
}

geodisk_status geodisk_job_record(geodisk_job* job, void* command_buffer, geodisk_next what,
                                  uint32_t amount, int32_t* is_last, geodisk_error* error) {
    return with_job(job, error, [&](geodisk_job& own) -> Result<Done> {
        if (command_buffer == nullptr) {
            return wrong("command_buffer is NULL");
        }
        if (own.to_bind) {
            return needs_buffers();
        }
        const auto recorded =
            record(own, static_cast<VkCommandBuffer>(command_buffer), what, amount);
        GEODISK_TRY(recorded);
        if (is_last != nullptr) {
            *is_last = *recorded ? 1 : 0;
        }
        return Done{};
    });
}

geodisk_status geodisk_job_advance(geodisk_job* job, const void* control, size_t bytes,
                                   geodisk_advice* advice, geodisk_error* error) {
    return with_job(job, error, [&](geodisk_job& own) -> Result<Done> {
        if (control == nullptr || bytes != sizeof(gpu::ControlRec)) {
            return wrong("control is NULL, or bytes is not " +
                         std::to_string(sizeof(gpu::ControlRec)));
        }
        if (!own.recorded) {
            return needs_buffers();
        }
        gpu::ControlRec record;
        std::memcpy(&record, control, sizeof record);
        const auto found = advise(own, record);
        return found ? give(advice, "advice", *found) : Result<Done>(found.error());
    });
}

geodisk_status geodisk_job_set_seed(geodisk_job* job, uint64_t seed, geodisk_error* error) {
    return with_job(job, error, [&](geodisk_job& own) -> Result<Done> {
        own.seed = seed;
        own.end_order = kAllOrders;
        if (own.recorded) {
            own.recorded->set_seed(seed);
            own.is_begun = false;
        }
        return Done{};
    });
}

geodisk_status geodisk_job_set_end_order(geodisk_job* job, uint64_t order, geodisk_error* error) {
    return with_job(job, error, [&](geodisk_job& own) -> Result<Done> {
        own.end_order = order;
        if (own.recorded) {
            own.recorded->set_end_order(order);
        }
        return Done{};
    });
}

geodisk_status geodisk_job_set_existing(geodisk_job* job, const geodisk_sample_record* samples,
                                        size_t count, geodisk_error* error) {
    return with_job(job, error, [&](geodisk_job& own) -> Result<Done> {
        if (samples == nullptr && count != 0) {
            return wrong("samples is NULL");
        }
        std::vector<gpu::SampleRec> settled(count);
        if (count != 0) {
            std::memcpy(settled.data(), samples, count * sizeof settled[0]);
        }
        GEODISK_TRY(plan_domain(own, own.domain, count));
        own.settled = std::move(settled);
        start_over(own);
        return Done{};
    });
}

geodisk_status geodisk_job_renew(geodisk_job* job, const geodisk_domain* domain,
                                 geodisk_error* error) {
    return with_job(job, error, [&](geodisk_job& own) -> Result<Done> {
        if (domain == nullptr) {
            return wrong("domain is NULL");
        }
        GEODISK_TRY(plan_domain(own, domain->shared, 0));
        own.seed.reset();
        own.end_order = kAllOrders;
        own.settled.reset();
        start_over(own);
        return Done{};
    });
}

void geodisk_job_release(geodisk_job* job) {
    delete job;
}

} // extern "C"
