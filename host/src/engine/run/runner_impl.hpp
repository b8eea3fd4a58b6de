// Runner::Impl, shared by the files that implement it.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include <geodisk/runner.hpp>

#include "engine/job/sampler_impl.hpp"
#include "engine/job/stage_clock.hpp"
#include "engine/run/pace.hpp"
#include "engine/run/run_memory.hpp"
#include "engine/run/submitter.hpp"
#include "engine/run/task.hpp"
#include "records.h"
#include "support/guard.hpp"
#include "support/try.hpp"
#include "vk/buffer.hpp"

namespace geodisk {

/// Returns the progress of a run of several jobs, from that of the one at hand.
using WholeProgress = std::function<Progress(const Progress&)>;

/// Work that a runner has in progress.
struct Work {
    Work() = default;
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;
    virtual ~Work() = default;
};
template <class T>
struct WorkOn final : Work {
    explicit WorkOn(Task<Result<T>> made) : task(std::move(made)) {}
    Task<Result<T>> task;
};

class Division;

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
        /// Pipelines that were dispatched with no work groups, so that they are compiled.
        const KernelPipelines* dispatched = nullptr;
    };
    std::array<KeptJob, kDomainKinds> jobs; ///< Indexed by index_of(DomainKind).
    std::map<KernelVariant, Paces> paces;
    std::unique_ptr<Work> work; ///< The run in progress: one job, or several.
    Progress progress{};
    ProgressCallback on_progress;
    WholeProgress as_whole;       ///< Set by a run of several jobs.
    Division* division = nullptr; ///< What the run in progress awaits, if it goes on in parts.

    /// Clock in seconds; tests may replace it.
    std::function<double()> now;

    explicit Impl(std::shared_ptr<const Sampler> s);
    ~Impl();

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
    /// Begins a run, as Runner::start(), of so many candidates.
    template <class T>
    Result<Done> begin(Task<Result<T>> task, std::uint32_t candidates,
                       const ProgressCallback& callback);
    /// Goes on with the run in progress, as Runner::poll(). It must be one for a T.
    template <class T>
    Result<std::optional<T>> poll(std::chrono::milliseconds patience) noexcept;
    /// Begins a run and waits for its end.
    template <class T>
    Result<T> complete(Task<Result<T>> task, std::uint32_t candidates,
                       const ProgressCallback& callback);
    /// Goes on with the run in progress, after waiting at most so long. Returns false if there is
    /// nothing new.
    bool go_on(std::chrono::milliseconds patience);
    /// Notes how far the job at hand is.
    void note(const Progress& of_job) { progress = as_whole ? as_whole(of_job) : of_job; }
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

template <class T>
Result<Done> Runner::Impl::begin(Task<Result<T>> task, std::uint32_t candidates,
                                 const ProgressCallback& callback) {
    if (work != nullptr) {
        return Error{Status::invalid_argument, "a run is in progress"};
    }
    progress = {};
    progress.candidates = candidates;
    on_progress = callback;
    as_whole = nullptr;
    auto begun = std::make_unique<WorkOn<T>>(std::move(task));
    const Task<Result<T>>& own = begun->task;
    work = std::move(begun);
    own.resume();
    return Done{};
}

template <class T>
Result<std::optional<T>> Runner::Impl::poll(std::chrono::milliseconds patience) noexcept {
    auto* const own = dynamic_cast<WorkOn<T>*>(work.get());
    if (own == nullptr) {
        return guarded([&]() -> Result<std::optional<T>> {
            return Error{Status::invalid_argument,
                         work ? "the run in progress is another: it was started for something else"
                              : "no run is in progress"};
        });
    }
    auto polled = guarded([&]() -> Result<std::optional<T>> {
        const bool goes_on = go_on(std::max(patience, {}));
        std::optional<T> result;
        if (own->task.is_done()) {
            auto ended = own->task.take();
            GEODISK_TRY(ended);
            result = std::move(*ended);
        }
        if (goes_on && on_progress && !on_progress(progress)) {
            cancel();
            release(); // Also if the run had ended.
            return Error{Status::cancelled, "cancelled"};
        }
        return result;
    });
    if (!polled || *polled) {
        cancel();
    }
    return polled;
}

template <class T>
Result<T> Runner::Impl::complete(Task<Result<T>> task, std::uint32_t candidates,
                                 const ProgressCallback& callback) {
    constexpr std::chrono::milliseconds kPatience(50);
    GEODISK_TRY(begin(std::move(task), candidates, callback));
    for (;;) {
        auto ended = poll<T>(kPatience);
        GEODISK_TRY(ended);
        if (*ended) {
            return std::move(**ended);
        }
    }
}

} // namespace geodisk
