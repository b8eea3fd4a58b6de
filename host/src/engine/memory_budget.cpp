#include "engine/memory_budget.hpp"

#include <algorithm>
#include <string>

#include "engine/domain_impl.hpp"
#include "engine/plan.hpp"

namespace geodisk {
namespace {

/// By what the device's heaps hold, a quarter of which is left for all else.
std::uint64_t candidates_in(const VkPhysicalDeviceMemoryProperties& memory,
                            const Domain::Impl& of) {
    VkDeviceSize largest = 0;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
        const VkMemoryHeap& heap = memory.memoryHeaps[i];
        if ((heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0) {
            largest = std::max(largest, heap.size);
        }
    }
    return largest / 4 * 3 / of.bytes_per_candidate;
}

} // namespace

std::uint64_t upload_bytes(const Sampler& sampler, const Domain& domain) {
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        bytes += sampler.upload_size(domain, static_cast<BufferRole>(i));
    }
    return bytes;
}

std::uint64_t bytes_of(const Sampler& sampler, const Domain& domain, const WorkspaceNeeds& needs) {
    return needs.total() + RunMemory::staging_bytes(upload_bytes(sampler, domain));
}

Result<RunPlan> plan_within(const Runner::Impl& runner, const Domain& domain, std::uint64_t bytes) {
    const Sampler& sampler = runner.sampler;
    const std::uint64_t one = sampler.report().limits.max_memory_allocation_size;
    std::uint64_t pool = std::min(runner.options.pool_bytes, one);
    const Domain::Impl& of = Domain::Impl::of(domain);
    std::uint32_t stages = stages_at_once(of.stages, candidates_in(runner.memory, of));
    for (;;) {
        auto plan = sampler.plan_run(domain, pool);
        if (!plan) {
            return plan;
        }
        plan->stages = std::min(plan->stages, stages);
        *plan = overridden(*plan, runner.options.plan);
        const auto needs = sampler.workspace_needs(domain, *plan);
        if (!needs) {
            return needs.error();
        }
        const std::uint64_t total = bytes_of(sampler, domain, *needs);
        const auto largest = *std::max_element(needs->bytes.begin(), needs->bytes.end());
        if (total <= bytes && largest <= one) {
            return plan;
        }
        const std::uint64_t half = plan->pool_bytes() / 2;
        const bool is_fixed = runner.options.plan.stages != 0 || plan->stages == 1;
        // The larger part first.
        const bool may_halve = half < pool && sampler.plan_run(domain, half);
        if (may_halve && (is_fixed || half >= total / 4)) {
            pool = half;
        } else if (!is_fixed) {
            stages = plan->stages - 1;
        } else {
            return Error{Status::out_of_device_memory,
                         largest > one ? "a buffer of the run takes " + std::to_string(largest) +
                                             " bytes, but the device allocates at most " +
                                             std::to_string(one) + " at once"
                                       : "the run takes " + std::to_string(total) +
                                             " bytes on the device at least, but may take only " +
                                             std::to_string(bytes)};
        }
    }
}

} // namespace geodisk
