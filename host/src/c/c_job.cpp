#include "c/c_job.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <utility>

#include "c/c_handles.hpp"
#include "records.h"

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
              GEODISK_START_OVER == static_cast<int>(Next::start_over) &&
              GEODISK_COMPLETE == static_cast<int>(Next::complete));
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
    if (!needs) {
        return needs.error();
    }
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
    } else if (advice.next == Next::start_over) {
        if (const auto planned = plan_buffers(job, *job.domain->domain, advice.plan); !planned) {
            return planned.error();
        }
    } else {
        return Done{};
    }
    job.to_bind = advice.next;
    return Done{};
}

bool is_larger(BufferRole role, Next next) noexcept {
    if (next == Next::larger_pool) {
        return role == BufferRole::pool;
    }
    return role == BufferRole::samples || role == BufferRole::accepted ||
           role == BufferRole::buckets;
}

Result<Done> bind_all(geodisk_job& job, const Workspace& workspace) {
    const Domain& domain = *job.domain->domain;
    if (job.recorded && workspace == job.workspace) {
        if (const auto renewed = job.recorded->renew(domain, job.plan); !renewed) {
            return renewed.error();
        }
    } else {
        auto made = job.sampler->make_job(domain, job.plan, workspace);
        if (!made) {
            return made.error();
        }
        job.recorded.emplace(std::move(*made));
    }
    job.is_begun = false;
    job.uploaded = {};
    if (job.seed) {
        job.recorded->set_seed(*job.seed);
    }
    return Done{};
}

Result<Done> bind_larger(geodisk_job& job, const Workspace& workspace, Next next) {
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        if (!(workspace[i] == job.workspace[i]) && !is_larger(static_cast<BufferRole>(i), next)) {
            return wrong("ranges[" + std::to_string(i) + "] is not what it was");
        }
    }
    const auto at = [&workspace](BufferRole role) -> const BufferRange& {
        return workspace[static_cast<std::size_t>(role)];
    };
    if (next == Next::larger_pool) {
        return job.recorded->set_plan(job.plan, at(BufferRole::pool));
    }
    return job.recorded->set_samples(job.sample_capacity, at(BufferRole::samples),
                                     at(BufferRole::accepted), at(BufferRole::buckets));
}

Result<Done> bind(geodisk_job& job, const geodisk_buffer_range* ranges) {
    if (!job.to_bind) {
        return wrong("the job needs no other buffers");
    }
    const Next next = *job.to_bind;
    Workspace workspace;
    std::transform(ranges, ranges + kBufferRoles, workspace.begin(), range_of);
    const auto bound =
        next == Next::start_over ? bind_all(job, workspace) : bind_larger(job, workspace, next);
    if (!bound) {
        return bound.error();
    }
    job.workspace = workspace;
    job.to_bind.reset();
    if (next != Next::start_over) {
        job.to_record = next;
    }
    return Done{};
}

/// Fails if a buffer with upload_bytes was not written: there would be no samples.
Result<Done> check_uploads(const geodisk_job& job) {
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        const auto role = static_cast<BufferRole>(i);
        if (!job.uploaded[i] && job.sampler->upload_size(*job.domain->domain, role) > 0) {
            return wrong("buffer " + std::to_string(i) + " (" + to_string(role) +
                         ") has no upload: call geodisk_job_upload for each buffer with "
                         "upload_bytes before GEODISK_BEGIN");
        }
    }
    return Done{};
}

Result<bool> record(geodisk_job& job, VkCommandBuffer commands, geodisk_next what,
                    std::uint32_t amount) {
    const std::uint32_t dispatches = amount != 0 ? amount : kAllDispatches;
    const Sampler& sampler = *job.sampler;
    const bool begins = what == GEODISK_BEGIN || what == GEODISK_START_OVER;
    if (!begins && !job.is_begun) { // Kernels would read uninitialized buffers.
        return wrong("GEODISK_BEGIN comes first");
    }
    if (begins) {
        if (const auto checked = check_uploads(job); !checked) {
            return checked.error();
        }
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
    case GEODISK_FINISH:
        return sampler.record_finish(commands, *job.recorded, dispatches);
    case GEODISK_LARGER_POOL:
    case GEODISK_LARGER_SAMPLES:
        if (!job.to_record || static_cast<geodisk_next>(*job.to_record) != what) {
            return wrong("no larger buffers of this kind were bound");
        }
        sampler.record_rewind(commands, *job.recorded);
        job.to_record.reset();
        return true;
    case GEODISK_COMPLETE:
        return true;
    default:
        return wrong("what is none of geodisk_next");
    }
}

Result<geodisk_advice> advise(geodisk_job& job, const gpu::ControlRec& control) {
    geodisk_advice advice{};
    // Until that is done, the control record stays the same.
    if (job.to_bind || job.to_record) {
        advice.next = static_cast<geodisk_next>(job.to_bind ? *job.to_bind : *job.to_record);
        advice.ready = job.ready;
        return advice;
    }
    const auto found = job.recorded->advance(control, job.pool_bytes);
    if (!found) {
        return found.error();
    }
    if (const auto asked = ask_for_buffers(job, *found); !asked) {
        return asked.error();
    }
    advice.next = static_cast<geodisk_next>(found->next);
    advice.ready = job.ready = found->ready;
    return advice;
}

Result<BufferRole> role_of(std::uint32_t buffer) {
    if (buffer >= kBufferRoles) {
        return wrong("buffer is " + std::to_string(buffer) + ", but there are " +
                     std::to_string(kBufferRoles));
    }
    return static_cast<BufferRole>(buffer);
}

/// Plans a run of the domain, which then belongs to the job. An error changes nothing.
Result<Done> plan_domain(geodisk_job& job, std::shared_ptr<const DomainState> state) {
    const Domain& domain = *state->domain;
    if (const auto prepared = job.sampler->prepare(domain); !prepared) {
        return prepared.error();
    }
    auto plan = job.sampler->plan_run(domain, job.pool_bytes);
    if (!plan) {
        return plan.error();
    }
    if (job.stages != 0) {
        plan->stages = std::min(job.stages, plan->stages);
    }
    if (const auto planned = plan_buffers(job, domain, *plan); !planned) {
        return planned.error();
    }
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
    if (!sampler) {
        return sampler.error();
    }
    job->sampler = std::move(*sampler);
    if (const auto planned = plan_domain(*job, domain.shared); !planned) {
        return planned.error();
    }
    return job;
}

} // namespace

Error needs_buffers() {
    return wrong("the job needs buffers, by geodisk_job_bind");
}

BufferRange range_of(const geodisk_buffer_range& given) noexcept {
    return {handle_of<VkBuffer>(given.buffer), given.offset, given.bytes};
}

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
        if (!wanted) {
            return wanted.error();
        }
        auto made = make_job(*device, *domain, *wanted);
        if (!made) {
            return made.error();
        }
        *job = made->release();
        return Done{};
    });
}

geodisk_status geodisk_job_need(geodisk_job* job, uint32_t buffer, geodisk_buffer_need* need,
                                geodisk_error* error) {
    return with_job(job, error, [&](geodisk_job& own) -> Result<Done> {
        const auto role = role_of(buffer);
        if (!role) {
            return role.error();
        }
        geodisk_buffer_need found{};
        found.bytes = own.needed[buffer];
        found.upload_bytes = own.sampler->upload_size(*own.domain->domain, *role);
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
        if (!role) {
            return role.error();
        }
        if (data == nullptr) {
            return wrong("data is NULL");
        }
        auto written = own.sampler->write_upload(*own.domain->domain, own.plan, *role,
                                                 {static_cast<std::byte*>(data), bytes});
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
        if (!recorded) {
            return recorded.error();
        }
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
        if (own.recorded) {
            own.recorded->set_seed(seed);
            own.is_begun = false;
        }
        return Done{};
    });
}

geodisk_status geodisk_job_renew(geodisk_job* job, const geodisk_domain* domain,
                                 geodisk_error* error) {
    return with_job(job, error, [&](geodisk_job& own) -> Result<Done> {
        if (domain == nullptr) {
            return wrong("domain is NULL");
        }
        if (const auto planned = plan_domain(own, domain->shared); !planned) {
            return planned.error();
        }
        own.seed.reset();
        own.to_bind = Next::start_over;
        own.to_record.reset();
        own.is_begun = false;
        return Done{};
    });
}

void geodisk_job_release(geodisk_job* job) {
    delete job;
}

} // extern "C"
