// What Runner holds; shared by the files that implement it.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <geodisk/runner.hpp>

#include "engine/job/sampler_impl.hpp"
#include "engine/job/stage_clock.hpp"
#include "engine/run/run_memory.hpp"
#include "engine/run/submitter.hpp"
#include "engine/run/task.hpp"
#include "records.h"
#include "vk/buffer.hpp"

namespace geodisk {

struct Runner::Impl {
    std::shared_ptr<const Sampler> shared_sampler;
    const Sampler& sampler = *shared_sampler;
    RunnerOptions options;
    /// Where what is free is to be asked for.
    PFN_vkGetPhysicalDeviceMemoryProperties2 memory_properties2 = nullptr;
    VkPhysicalDeviceMemoryProperties memory{};
    std::optional<Submitter> submitter;
    std::optional<StageClock> clock;
    // Kept from run to run.
    std::optional<RunMemory> workspace;
    struct KeptJob {
        std::optional<Job> job;
        std::uint32_t made = 0; ///< RunMemory::made() of the buffers that it is bound to.
    };
    std::array<KeptJob, kDomainKinds> jobs; ///< By index_of(DomainKind).
    // Of the run that was started.
    std::optional<Task<Result<SampleSet>>> run;
    Progress progress{};
    ProgressCallback on_progress;

    /// Seconds since some moment; of a test where it says so.
    std::function<double()> now;

    explicit Impl(std::shared_ptr<const Sampler> s);
    ~Impl() {
        cancel();
        settle();
    }

    /// Once a submission was given up, keeps all that it may still use from being destroyed. The
    /// buffers are left to whoever owns them.
    void settle() noexcept {
        if (submitter && submitter->abandoned()) {
            sampler.impl_->abandon();
            if (clock) {
                clock->abandon();
            }
        }
    }

    static Impl& of(Runner& runner) { return *runner.impl_; }
    /// Makes room for what is kept.
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
    const Sampler::Impl& engine() const { return *sampler.impl_; }
    /// As Submitter::submit, for what a job records; StageClock::collect tells its times.
    Result<Done> submit_timed(const std::function<void(VkCommandBuffer)>& record);
    /// Ends a run that was started, whatever it has come to.
    void cancel() noexcept;
    bool is_cpu() const { return engine().report.type == VK_PHYSICAL_DEVICE_TYPE_CPU; }
    std::chrono::duration<double> stall_limit() const;
    /// That a submission is to take.
    double submission_seconds() const;
    /// Bytes of device memory that a run may take: as the caller says, and as there are free.
    std::uint64_t bytes_allowed() const;
    Result<DeviceBuffer> allocate(VkDeviceSize bytes, VkBufferUsageFlags usage,
                                  MemoryKind kind) const;

    /// Compares what the self_test kernel computes with the host's arithmetic, bit by bit.
    Result<Done> check_rounding();
};

} // namespace geodisk
