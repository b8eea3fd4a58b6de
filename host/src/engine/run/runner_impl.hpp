// Runner::Impl, shared by the files that implement it.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <geodisk/runner.hpp>

#include "engine/job/sampler_impl.hpp"
#include "engine/job/stage_clock.hpp"
#include "engine/run/pace.hpp"
#include "engine/run/run_memory.hpp"
#include "engine/run/submitter.hpp"
#include "engine/run/task.hpp"
#include "records.h"
#include "vk/buffer.hpp"

namespace geodisk {

struct DiskRecords;

struct Runner::Impl {
    std::shared_ptr<const Sampler> shared_sampler;
    const Sampler& sampler = *shared_sampler;
    RunnerOptions options;
    /// Set if the free memory can be queried.
    PFN_vkGetPhysicalDeviceMemoryProperties2 memory_properties2 = nullptr;
    VkPhysicalDeviceMemoryProperties memory{};
    std::optional<Submitter> submitter;
    std::optional<StageClock> clock;
    // Kept from run to run.
    std::optional<RunMemory> workspace;
    struct KeptJob {
        std::optional<Job> job;
        std::uint32_t made = 0; ///< RunMemory::made() when it was bound.
    };
    std::array<KeptJob, kDomainKinds> jobs; ///< Indexed by index_of(DomainKind).
    std::map<KernelVariant, Paces> paces;
    // The run in progress.
    std::optional<Task<Result<SampleSet>>> run;
    Progress progress{};
    ProgressCallback on_progress;

    /// Clock in seconds; tests may replace it.
    std::function<double()> now;

    explicit Impl(std::shared_ptr<const Sampler> s);
    ~Impl() {
        cancel();
        settle();
    }

    /// After a submission is given up, keeps everything that it may still use from being destroyed.
    /// The owner of the buffers keeps those.
    void settle() noexcept {
        if (submitter && submitter->abandoned()) {
            sampler.impl_->abandon();
            if (clock) {
                clock->abandon();
            }
        }
    }

    static Impl& of(Runner& runner) { return *runner.impl_; }
    /// Allocates what is kept.
    void keep() {
        if (!workspace) {
            workspace.emplace(engine(), *submitter, memory);
        }
    }
    /// Frees what is kept.
    void release() noexcept {
        settle();
        jobs = {};
        workspace.reset();
    }
    /// Returns what is known of the work of these kernels.
    Paces& paces_of(const KernelVariant& variant) {
        const Pace unknown(submission_seconds());
        return paces.try_emplace(variant, Paces{unknown, unknown}).first->second;
    }
    const Sampler::Impl& engine() const { return *sampler.impl_; }
    /// Submits recordings of a job, as Submitter::submit; StageClock::collect returns their times.
    Result<Done> submit_timed(const std::function<void(VkCommandBuffer)>& record);
    /// Begins a run, as Runner::start(). `records` as for run_job().
    Result<Done> begin(const Domain& domain, DiskRecords* records,
                       const ProgressCallback& progress);
    /// Ends the run in progress.
    void cancel() noexcept;
    bool is_cpu() const { return engine().report.type == VK_PHYSICAL_DEVICE_TYPE_CPU; }
    std::chrono::duration<double> stall_limit() const;
    /// Returns the target length of a submission.
    double submission_seconds() const;
    /// Returns the device bytes that a run may use: limited by the caller and by the free memory.
    std::uint64_t bytes_allowed() const;
    /// Returns the bytes that records of disks may take at once.
    double record_bytes() const;
    Result<DeviceBuffer> allocate(VkDeviceSize bytes, VkBufferUsageFlags usage,
                                  MemoryKind kind) const;

    /// Compares the self_test kernel with the host's arithmetic, bit by bit.
    Result<Done> check_rounding();
};

} // namespace geodisk
