#include "engine/run/memory_budget.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/capacity.hpp"
#include "engine/domain/domain_impl.hpp"
#include "engine/job/plan.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Returns the candidates that fit the device's heaps; a quarter is left for other uses.
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

Result<Fitting> fit_plan(const Runner::Impl& runner, const Domain& domain, std::uint64_t bytes,
                         std::uint32_t samples) {
    const Sampler& sampler = runner.sampler;
    const std::uint64_t one = sampler.report().limits.max_memory_allocation_size;
    std::uint64_t pool = std::min(runner.options.pool_bytes, one);
    const Domain::Impl& of = Domain::Impl::of(domain);
    std::uint32_t stages = stages_at_once(of.stages, candidates_in(runner.memory, of));
    for (;;) {
        const auto planned = sampler.plan_run(domain, pool);
        GEODISK_TRY(planned);
        RunPlan wanted = runner.options.plan;
        wanted.disks_by = of.kernels.records() ? DisksBy::automatic : wanted.disks_by;
        Fitting fitting{overridden(*planned, wanted)};
        RunPlan& plan = fitting.plan;
        // Darts always come one stage at a time, and a list has one.
        const bool is_fixed =
            runner.options.plan.stages != 0 && of.stages.source == CandidateSource::pool;
        plan.stages = is_fixed ? plan.stages : std::min(plan.stages, stages);
        plan.sample_capacity = std::max(plan.sample_capacity, samples);
        const auto needs = sampler.workspace_needs(domain, plan);
        GEODISK_TRY(needs);
        fitting.bytes = needs->total() + RunMemory::staging_bytes(upload_bytes(sampler, domain));
        const auto largest = std::max_element(needs->bytes.begin(), needs->bytes.end());
        fitting.largest = static_cast<BufferRole>(largest - needs->bytes.begin());
        fitting.largest_bytes = *largest;
        fitting.fits = fitting.bytes <= bytes && *largest <= one;
        if (fitting.fits) {
            return fitting;
        }
        const std::uint64_t half = plan.pool_bytes() / 2;
        const bool may_halve = half < pool && sampler.plan_run(domain, half);
        const bool may_shorten = !is_fixed && plan.stages > 1;
        if (!may_halve && !may_shorten) {
            return fitting;
        }
        // Reduce the larger part first.
        if (may_halve && (!may_shorten || half >= fitting.bytes / 4)) {
            pool = half;
        } else {
            stages = plan.stages - 1;
        }
    }
}

Result<Fitting> fit_within(const Runner::Impl& runner, const Domain& domain, std::uint64_t bytes,
                           std::uint32_t samples) {
    auto fitting = fit_plan(runner, domain, bytes, samples);
    if (!fitting || fitting->fits) {
        return fitting;
    }
    const std::uint64_t one = runner.sampler.report().limits.max_memory_allocation_size;
    std::string message = "the run takes " + std::to_string(fitting->bytes) +
                          " bytes on the device at least, but may take only " +
                          std::to_string(bytes);
    if (fitting->largest_bytes > one) {
        message = std::string("the buffer ") + Domain::Impl::of(domain).name_of(fitting->largest) +
                  " of the run takes " + std::to_string(fitting->largest_bytes) +
                  " bytes, but the device allocates at most " + std::to_string(one) + " at once";
    }
    return Error{Status::out_of_device_memory, std::move(message)};
}

} // namespace geodisk
