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

static_assert(GEODISK_BUFFERS == kBufferRoles && GEODISK_BUFFER_USAGE == kWorkspaceUsage);
static_assert(GEODISK_POOL_BUFFER == static_cast<int>(BufferRole::pool) &&
              GEODISK_CONTROL_BUFFER == static_cast<int>(BufferRole::control) &&
              GEODISK_SAMPLES_BUFFER == static_cast<int>(BufferRole::samples) &&
              GEODISK_ACCEPTED_BUFFER == static_cast<int>(BufferRole::accepted));
static_assert(GEODISK_BEGIN == static_cast<int>(Next::begin) &&
              GEODISK_GO_ON == static_cast<int>(Next::go_on) &&
              GEODISK_FINISH == static_cast<int>(Next::finish) &&
              GEODISK_LARGER_POOL == static_cast<int>(Next::larger_pool) &&
              GEODISK_LARGER_SAMPLES == static_cast<int>(Next::larger_samples) &&
              GEODISK_COMPLETE == static_cast<int>(Next::complete) &&
              GEODISK_COUNT == static_cast<int>(Next::count) &&
              GEODISK_PAUSED == static_cast<int>(Next::paused) && GEODISK_ALL_ORDERS == kAllOrders);
static_assert(sizeof(geodisk_sample_record) == sizeof(gpu::SampleRec) &&
              offsetof(geodisk_sample_record, face) == offsetof(gpu::SampleRec, face) &&
              offsetof(geodisk_sample_record, weight2) == offsetof(gpu::SampleRec, weight2));

constexpr std::uint64_t kPoolBytes = std::uint64_t{256} << 20; // Same default as RunnerOptions.

std::uint64_t& needed_by(geodisk_job& job, BufferRole role) {
    return job.needed[static_cast<std::size_t>(role)];
}

/// Plans the run and all its buffers.
Result<Done> plan_buffers(geodisk_job& job, const Domain& domain, const RunPlan& plan) {
    const auto needs = job.sampler->workspace_needs(domain, plan, job.regrowths);
    GEODISK_TRY(needs);
    std::copy(needs->bytes.begin(), needs->bytes.end(), job.needed.begin());
    job.plan = plan;
    return Done{};
}

/// Computes the buffers that the next step needs.
Result<Done> ask_for_buffers(geodisk_job& job, const Advice& advice) {
    if (advice.next == Next::larger_pool) {
        job.plan = advice.plan;
        needed_by(job, BufferRole::pool) = advice.plan.pool_bytes();
    } else if (advice.next == Next::larger_samples) {
        job.sample_capacity = advice.sample_capacity;
        const auto bytes = job.recorded->sample_bytes(advice.sample_capacity);
        needed_by(job, BufferRole::samples) = bytes[0];
        needed_by(job, BufferRole::accepted) = bytes[1];
        needed_by(job, BufferRole::buckets) = bytes[2];
    } else {
        return Done{};
    }
    job.to_bind = static_cast<geodisk_next>(advice.next);
    return Done{};
}

bool is_larger(BufferRole role, geodisk_next next) noexcept {
    if (next == GEODISK_LARGER_POOL) {
        return role == BufferRole::pool;
    }
    return role == BufferRole::samples || role == BufferRole::accepted ||
           role == BufferRole::buckets;
}

Result<Done> bind_all(geodisk_job& job, const Workspace& workspace) {
    const Domain& domain = *job.domain->domain;
    if (job.recorded && workspace == job.workspace) {
        GEODISK_TRY(job.recorded->renew(domain, job.plan));
    } else {
        auto made = job.sampler->make_job(domain, job.plan, workspace);
        GEODISK_TRY(made);
        job.recorded.emplace(std::move(*made));
    }
    job.is_begun = false;
    job.uploaded = {};
    if (job.settled) {
        GEODISK_TRY(job.recorded->set_existing(*job.settled));
    }
    if (job.seed) {
        job.recorded->set_seed(*job.seed);
    }
    job.recorded->set_end_order(job.end_order);
    return Done{};
}

Result<Done> bind_larger(geodisk_job& job, const Workspace& workspace, geodisk_next next) {
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        if (!(workspace[i] == job.workspace[i]) && !is_larger(static_cast<BufferRole>(i), next)) {
            return wrong("ranges[" + std::to_string(i) + "] is not what it was");
        }
    }
    const auto at = [&workspace](BufferRole role) -> const BufferRange& {
        return workspace[static_cast<std::size_t>(role)];
    };
    if (next == GEODISK_LARGER_POOL) {
        return job.recorded->set_plan(job.plan, at(BufferRole::pool));
    }
    return job.recorded->set_samples(job.sample_capacity, at(BufferRole::samples),
                                     at(BufferRole::accepted), at(BufferRole::buckets));
}

} // namespace

Result<Done> bind(geodisk_job& job, const geodisk_buffer_range* ranges) {
    if (!job.to_bind) {
        return wrong("the job needs no other buffers");
    }
    const geodisk_next next = *job.to_bind;
    Workspace workspace;
    std::transform(ranges, ranges + kBufferRoles, workspace.begin(), range_of);
    const auto bound =
        next == GEODISK_START_OVER ? bind_all(job, workspace) : bind_larger(job, workspace, next);
    GEODISK_TRY(bound);
    job.workspace = workspace;
    job.to_bind.reset();
    if (next != GEODISK_START_OVER) {
        job.to_record = next;
    }
    return Done{};
}

std::size_t upload_bytes(const geodisk_job& job, BufferRole role) {
    return role == BufferRole::samples && job.settled
               ? job.settled->size() * sizeof(gpu::SampleRec)
               : job.sampler->upload_size(*job.domain->domain, role);
}

Result<Done> write_upload(const geodisk_job& job, BufferRole role, std::span<std::byte> out) {
    if (role != BufferRole::samples || !job.settled) {
        return job.sampler->write_upload(*job.domain->domain, job.plan, role, out);
    }
    const auto bytes = std::as_bytes(std::span(*job.settled));
    if (out.size() != bytes.size()) {
        return wrong("bytes is not upload_bytes of the buffer");
    }
    std::copy(bytes.begin(), bytes.end(), out.begin());
    return Done{};
}

namespace {

/// Fails if a buffer with upload_bytes was not written: there would be no samples.
Result<Done> check_uploads(const geodisk_job& job) {
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        const auto role = static_cast<BufferRole>(i);
        if (!job.uploaded[i] && upload_bytes(job, role) > 0) {
            return wrong("buffer " + std::to_string(i) + " (" + to_string(role) +
                         ") has no upload: call geodisk_job_upload for each buffer with "
                         "upload_bytes before GEODISK_BEGIN");
        }
    }
    return Done{};
}

} // namespace

Result<bool> record(geodisk_job& job, VkCommandBuffer commands, geodisk_next what,
                    std::uint32_t amount) {
    const std::uint32_t dispatches = amount != 0 ? amount : kAllDispatches;
    const Sampler& sampler = *job.sampler;
    const bool begins = what == GEODISK_BEGIN || what == GEODISK_START_OVER;
    if (!begins && !job.is_begun) { // Kernels would read uninitialized buffers.
        return wrong("GEODISK_BEGIN comes first");
    }
    if (begins) {
        GEODISK_TRY(check_uploads(job));
    }
    switch (what) {
    case GEODISK_BEGIN:
    case GEODISK_START_OVER:
        job.is_begun = true;
        job.to_record.reset();
        return sampler.record_begin(commands, *job.recorded, dispatches);
    case GEODISK_GO_ON:
        sampler.record_rounds(commands, *job.recorded, std::max(amount, 1u));
        return true;
    case GEODISK_SELECT:
        sampler.record_select(commands, *job.recorded);
        return true;
    case GEODISK_DETECT:
        sampler.record_detect(commands, *job.recorded);
        return true;
    case GEODISK_RESOLVE:
        sampler.record_resolve(commands, *job.recorded);
        return true;
    case GEODISK_COUNT:
        return sampler.record_count(commands, *job.recorded, dispatches);
    case GEODISK_FINISH:
        return sampler.record_finish(commands, *job.recorded, dispatches);
    case GEODISK_LARGER_POOL:
    case GEODISK_LARGER_SAMPLES:
        if (job.to_record != what) {
            return wrong("no larger buffers of this kind were bound");
        }
        sampler.record_rewind(commands, *job.recorded);
        job.to_record.reset();
        return true;
    case GEODISK_COMPLETE:
    case GEODISK_PAUSED:
        return true;
    default:
        return wrong("what is none of geodisk_next");
    }
}

Result<geodisk_advice> advise(geodisk_job& job, const gpu::ControlRec& control) {
    geodisk_advice advice{};
    // Until that is done, the control record stays the same.
    if (job.to_bind || job.to_record) {
        advice.next = job.to_bind ? *job.to_bind : *job.to_record;
        advice.ready = job.ready;
        return advice;
    }
    const auto found = job.recorded->advance(control, job.pool_bytes);
    GEODISK_TRY(found);
    GEODISK_TRY(ask_for_buffers(job, *found));
    advice.next = static_cast<geodisk_next>(found->next);
    advice.ready = job.ready = found->ready;
    advice.candidates = found->candidates;
    return advice;
}

void start_over(geodisk_job& job) {
    job.to_bind = GEODISK_START_OVER;
    job.to_record.reset();
    job.is_begun = false;
}

Result<Done> plan_domain(geodisk_job& job, std::shared_ptr<const DomainState> state,
                         std::size_t settled) {
    const Domain& domain = *state->domain;
    GEODISK_TRY(job.sampler->prepare(domain));
    auto plan = job.sampler->plan_run(domain, job.pool_bytes);
    GEODISK_TRY(plan);
    if (job.stages != 0) {
        plan->stages = std::min(job.stages, plan->stages);
    }
    if (settled > ~plan->sample_capacity) {
        return wrong("count is more than a run can have");
    }
    plan->sample_capacity += static_cast<std::uint32_t>(settled);
    GEODISK_TRY(plan_buffers(job, domain, *plan));
    job.domain = std::move(state);
    return Done{};
}

Result<std::unique_ptr<geodisk_job>> make_job(const geodisk_device& device,
                                              const geodisk_domain& domain,
                                              const geodisk_job_options& options) {
    auto job = std::make_unique<geodisk_job>();
    job->device = device.shared;
    job->pool_bytes = options.pool_bytes != 0 ? options.pool_bytes : kPoolBytes;
    job->stages = options.stages;
    job->regrowths = options.regrowths;
    auto sampler = device.shared->sampler();
    GEODISK_TRY(sampler);
    job->sampler = std::move(*sampler);
    GEODISK_TRY(plan_domain(*job, domain.shared, 0));
    return job;
}

Error needs_buffers() {
    return wrong("the job needs buffers, by geodisk_job_bind");
}

BufferRange range_of(const geodisk_buffer_range& given) noexcept {
    return {handle_of<VkBuffer>(given.buffer), given.offset, given.bytes};
}

} // namespace geodisk::c
