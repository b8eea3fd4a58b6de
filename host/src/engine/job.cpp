#include <algorithm>
#include <bit>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/sampler.hpp>

#include "bindings.h"
#include "records.h"
#include "engine/plan.hpp"
#include "engine/sampler_impl.hpp"
#include "support/guard.hpp"
#include "vk/result.hpp"

namespace geodisk {
namespace {

Error range_error(Status status, std::size_t role, const std::string& what) {
    return Error{status, std::string("the workspace's buffer ") + to_string(static_cast<BufferRole>(role)) + ' ' + what};
}

Result<Done> check_range(const BufferRange& range, std::size_t role, VkDeviceSize needed,
                         const DeviceLimits& limits) {
    if (range.buffer == VK_NULL_HANDLE) {
        return range_error(Status::invalid_argument, role, "is null");
    }
    if (range.size < needed) {
        return range_error(Status::workspace_too_small, role,
                           "has " + std::to_string(range.size) + " bytes and needs " +
                               std::to_string(needed));
    }
    if (range.size > limits.max_storage_buffer_range) {
        return range_error(Status::invalid_argument, role,
                           "has " + std::to_string(range.size) +
                               " bytes, but the device binds at "
                               "most " +
                               std::to_string(limits.max_storage_buffer_range));
    }
    const std::uint64_t alignment = limits.min_storage_buffer_offset_alignment;
    if (range.offset % alignment != 0) {
        return range_error(Status::invalid_argument, role,
                           "starts at " + std::to_string(range.offset) +
                               ", off the device's alignment of " + std::to_string(alignment));
    }
    return Done{};
}

bool overlap(const BufferRange& a, const BufferRange& b) {
    return a.buffer == b.buffer && a.offset < b.offset + b.size && b.offset < a.offset + a.size;
}

Result<Done> check_workspace(const Workspace& workspace, const WorkspaceNeeds& needs,
                             const DeviceLimits& limits) {
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        if (auto checked = check_range(workspace[i], i, needs.bytes[i], limits); !checked) {
            return checked;
        }
        for (std::size_t k = 0; k < i; ++k) {
            if (overlap(workspace[i], workspace[k])) {
                return range_error(Status::invalid_argument, i,
                                   std::string("overlaps the buffer ") + to_string(static_cast<BufferRole>(k)));
            }
        }
    }
    return Done{};
}

/// What the shaders rely on without looking.
Result<Done> check_plan(const RunPlan& plan) {
    constexpr std::uint32_t kMost = 1u << 26;
    const bool fine = plan.slots >= 1 && plan.window_capacity >= 2 &&
                      std::has_single_bit(plan.window_capacity) && std::has_single_bit(plan.table_capacity) &&
                      plan.list_capacity >= 4 && plan.list_capacity % 4 == 0 &&
                      plan.lanes >= 1 && plan.lanes <= kMost && plan.step_budget >= 1 && plan.detect_passes >= 1 &&
                      plan.detect_passes <= 4096 && plan.sample_capacity >= 1 && plan.slots <= kMost &&
                      plan.window_capacity <= kMost && plan.table_capacity <= kMost &&
                      plan.list_capacity <= kMost;
    if (!fine) {
        return Error{Status::invalid_argument,
                     "the plan is not as RunPlan asks: slots, lanes, step_budget, detect_passes and "
                     "sample_capacity at least 1, "
                     "window_capacity and table_capacity powers of two, list_capacity a "
                     "multiple of 4, none of them 0 or more than 2^26"};
    }
    return Done{};
}

} // namespace

Job::Job(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Job::Job(Job&&) noexcept = default;
Job& Job::operator=(Job&&) noexcept = default;
Job::~Job() = default;

const RunPlan& Job::plan() const noexcept {
    return impl_->plan;
}
std::uint32_t Job::candidates() const noexcept {
    return impl_->push.candidates;
}

Job::Impl::~Impl() {
    if (!sampler->abandoned) {
        sampler->vk.vkDestroyDescriptorPool(sampler->device.device, descriptor_pool,
                                            sampler->device.host_allocator);
    }
}

void Job::Impl::apply_plan(const RunPlan& new_plan) {
    plan = new_plan;
    push.slots = plan.slots;
    push.window_capacity = plan.window_capacity;
    push.table_capacity = plan.table_capacity;
    push.list_capacity = plan.list_capacity;
    push.lanes = plan.lanes;
    push.lane_rows = plan.lane_rows();
    push.step_budget = std::min(plan.step_budget, most_steps(sampler->report));
    push.sample_capacity = plan.sample_capacity;
}

Result<Done> Job::set_plan(const RunPlan& plan) noexcept {
    return guarded([&]() -> Result<Done> {
        if (auto checked = check_plan(plan); !checked) {
            return checked;
        }
        const VkDeviceSize pool = impl_->workspace[gpu::kBindPool].size;
        if (plan.pool_bytes() > pool || plan.slots > impl_->most_slots) {
            return Error{Status::workspace_too_small,
                         "the plan needs a pool of " + std::to_string(plan.pool_bytes()) +
                             " bytes and " + std::to_string(plan.slots) +
                             " slots; the workspace has " + std::to_string(pool) + " bytes and " +
                             std::to_string(impl_->most_slots) + " slots"};
        }
        impl_->apply_plan(plan);
        return Done{};
    });
}

Result<Done> Job::set_plan(const RunPlan& plan, const BufferRange& pool) noexcept {
    return guarded([&]() -> Result<Done> {
        if (auto checked =
                check_range(pool, gpu::kBindPool, plan.pool_bytes(), impl_->sampler->report.limits);
            !checked) {
            return checked;
        }
        const BufferRange before = std::exchange(impl_->workspace[gpu::kBindPool], pool);
        auto done = set_plan(plan);
        if (!done) {
            impl_->workspace[gpu::kBindPool] = before;
            return done;
        }
        for (std::uint32_t role = 0; role < kSetRoles; ++role) {
            impl_->write_binding(static_cast<SetRole>(role), gpu::kBindPool);
        }
        return done;
    });
}

Result<Done> Job::set_samples(const BufferRange& samples) noexcept {
    return guarded([&]() -> Result<Done> {
        if (auto checked = check_range(samples, gpu::kBindSamples, sizeof(gpu::SampleRec),
                                       impl_->sampler->report.limits);
            !checked) {
            return checked;
        }
        impl_->workspace[gpu::kBindSamples] = samples;
        impl_->plan.sample_capacity = static_cast<std::uint32_t>(std::min<VkDeviceSize>(
            samples.size / sizeof(gpu::SampleRec), impl_->push.candidates));
        impl_->push.sample_capacity = impl_->plan.sample_capacity;
        impl_->write_binding(SetRole::workspace, gpu::kBindSamples);
        return Done{};
    });
}

Result<Job> Sampler::make_job(const PreparedMesh& mesh, const SampleParams& params,
                              const RunPlan& plan, const Workspace& workspace) const noexcept {
    return guarded([&]() -> Result<Job> {
        if (auto checked = check_plan(plan); !checked) {
            return checked.error();
        }
        auto needs = workspace_needs(mesh, params, plan);
        if (!needs) {
            return needs.error();
        }
        if (auto checked = check_workspace(workspace, *needs, impl_->report.limits); !checked) {
            return checked.error();
        }
        auto job = std::make_unique<Job::Impl>();
        job->sampler = impl_.get();
        job->workspace = workspace;
        job->most_slots = plan.slots;
        const Tolerances tolerances = tolerances_for(mesh, params.min_distance, plan.chain);
        gpu::Push& push = job->push;
        push.candidates = *pool_size(mesh, params);
        push.faces = mesh.face_count();
        push.vertices = mesh.vertex_count();
        push.cells = static_cast<std::uint32_t>(needs->bytes[gpu::kBindCells] / 4 - 1);
        push.seed_low = static_cast<std::uint32_t>(params.seed);
        push.seed_high = static_cast<std::uint32_t>(params.seed >> 32);
        push.limit = tolerances.limit;
        push.margin = tolerances.margin;
        push.slack = tolerances.slack;
        push.splits_once = mesh.statistics().nonmanifold_edges == 0 ? 1 : 0;
        job->apply_plan(plan);
        if (auto written = job->write_sets(); !written) {
            return written.error();
        }
        return Job(std::move(job));
    });
}

Result<Done> Job::Impl::write_sets() {
    const DeviceTable& vk = sampler->vk;
    const VkDevice device = sampler->device.device;
    constexpr std::uint32_t kSets = kSetRoles * kKernels;
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 8 * kSets};
    VkDescriptorPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool_info.maxSets = kSets;
    pool_info.poolSizeCount = 1;
    pool_info.pPoolSizes = &size;
    VkResult result = null_unless_success(vk.vkCreateDescriptorPool(device, &pool_info,
                                                                    sampler->device.host_allocator,
                                                                    &descriptor_pool),
                                          descriptor_pool);
    if (result != VK_SUCCESS) {
        return vk_error("vkCreateDescriptorPool", result);
    }
    for (std::uint32_t role = 0; role < kSetRoles; ++role) {
        VkDescriptorSetAllocateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
        info.descriptorPool = descriptor_pool;
        info.descriptorSetCount = kKernels;
        info.pSetLayouts = sampler->set_layouts.data();
        result = vk.vkAllocateDescriptorSets(device, &info, sets[role].data());
        if (result != VK_SUCCESS) {
            return vk_error("vkAllocateDescriptorSets", result);
        }
        for (std::uint32_t binding = 0; binding < gpu::kBindCount; ++binding) {
            write_binding(static_cast<SetRole>(role), binding);
        }
    }
    return Done{};
}

void Job::Impl::write_binding(SetRole role, std::uint32_t binding) const {
    for (std::size_t k = 0; k < kKernels; ++k) {
        const auto bindings = kernel_info(static_cast<Kernel>(k)).bindings;
        if (std::find(bindings.begin(), bindings.end(), binding) == bindings.end()) {
            continue;
        }
        // The scan kernels work on whatever is bound as marks.
        const bool cells = role == SetRole::cell_scan && binding == gpu::kBindMarks;
        const BufferRange& range = workspace[cells ? gpu::kBindCells : binding];
        const VkDescriptorBufferInfo buffer{range.buffer, range.offset, range.size};
        VkWriteDescriptorSet write{};
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = sets[static_cast<std::size_t>(role)][k];
        write.dstBinding = binding;
        write.descriptorCount = 1;
        write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        write.pBufferInfo = &buffer;
        sampler->vk.vkUpdateDescriptorSets(sampler->device.device, 1, &write, 0, nullptr);
    }
}

} // namespace geodisk
