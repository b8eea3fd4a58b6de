// What Runner holds; shared by the files that implement it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <geodisk/runner.hpp>

#include "engine/sampler_impl.hpp"
#include "engine/stage_clock.hpp"
#include "engine/submitter.hpp"
#include "records.h"
#include "vk/buffer.hpp"

namespace geodisk {

struct Runner::Impl {
    Sampler sampler;
    RunnerOptions options;
    VkPhysicalDeviceMemoryProperties memory{};
    std::optional<Submitter> submitter;
    std::optional<StageClock> clock;

    /// Opens the queue and checks the device's arithmetic.
    static Result<std::unique_ptr<Impl>> create(Result<Sampler> sampler, const QueueRef& queue,
                                                const RunnerOptions& options);
    explicit Impl(Sampler s) : sampler(std::move(s)) {}
    ~Impl() { settle(); }

    /// Once a submission was given up, keeps all that it may still use from being destroyed. The
    /// buffers are left to whoever owns them.
    void settle() noexcept {
        if (submitter && submitter->abandoned()) {
            sampler.impl_->abandoned = true;
            if (clock) {
                clock->abandon();
            }
        }
    }

    const Sampler::Impl& engine() const { return *sampler.impl_; }
    /// As Submitter::run, for what a job records.
    Result<Done> run_timed(const std::function<void(VkCommandBuffer)>& record);
    /// Bytes of device memory that candidates may take.
    VkDeviceSize memory_for_candidates() const;
    Result<DeviceBuffer> allocate(VkDeviceSize bytes, VkBufferUsageFlags usage,
                                  MemoryKind kind) const;

    /// Compares what the self_test kernel computes with the host's arithmetic, bit by bit.
    Result<Done> check_rounding();
};

/// The buffers of one run and its staging.
struct RunMemory {
    std::array<DeviceBuffer, kBufferRoles> buffers;
    DeviceBuffer staging;

    Workspace workspace() const;
    std::uint64_t bytes() const;
    void abandon() noexcept;
};

/// What a run samples.
class RunSource {
  public:
    virtual ~RunSource() = default;
    virtual const Stages& stages() const = 0;
    /// Of device memory, about.
    virtual std::uint64_t bytes_per_candidate() const = 0;
    /// Samples to stop at; 0 for none.
    virtual std::uint32_t stop_count() const { return 0; }
    virtual Result<RunPlan> plan(std::uint64_t pool_bytes) const = 0;
    virtual Result<WorkspaceNeeds> needs(const RunPlan& plan) const = 0;
    virtual Result<Job> make_job(const RunPlan& plan, const Workspace& workspace) const = 0;
    /// What to upload before the run; empty for most buffers.
    virtual Result<std::vector<std::byte>> bytes(BufferRole role) const = 0;
    virtual double guard(const RunPlan& plan) const = 0;
};

/// A mesh and what is asked of it; all must outlive the source.
class SurfaceSource : public RunSource {
  public:
    SurfaceSource(const Sampler& sampler, const PreparedMesh& mesh, const SampleParams& params)
        : sampler_(sampler), mesh_(mesh), params_(params), stages_(stages_of(mesh, params)) {}

    const Stages& stages() const override { return stages_; }
    std::uint64_t bytes_per_candidate() const override { return 16; }
    std::uint32_t stop_count() const override { return params_.stop_count; }
    Result<RunPlan> plan(std::uint64_t pool_bytes) const override {
        return sampler_.plan_run(mesh_, params_, pool_bytes);
    }
    Result<WorkspaceNeeds> needs(const RunPlan& plan) const override {
        return sampler_.workspace_needs(mesh_, params_, plan);
    }
    Result<Job> make_job(const RunPlan& plan, const Workspace& workspace) const override {
        return sampler_.make_job(mesh_, params_, plan, workspace);
    }
    Result<std::vector<std::byte>> bytes(BufferRole role) const override {
        std::vector<std::byte> bytes(sampler_.mesh_bytes_size(mesh_, params_, role));
        if (!bytes.empty()) {
            if (auto written = sampler_.mesh_bytes(mesh_, params_, role, bytes); !written) {
                return written.error();
            }
        }
        return bytes;
    }
    double guard(const RunPlan& plan) const override {
        return tolerances_for(mesh_, params_, plan.chain).guard;
    }

  private:
    const Sampler& sampler_;
    const PreparedMesh& mesh_;
    const SampleParams& params_;
    Stages stages_;
};

struct RunResult {
    std::vector<gpu::SampleRec> samples; ///< In dart-throwing order.
    RunReport report;
};

/// Of a run on a surface.
SampleSet to_samples(const RunResult& result);

/// Runs until window chains are as short as the guard provides for.
Result<RunResult> run_and_wait(Runner::Impl& runner, const RunSource& source,
                               const ProgressCallback& progress);

} // namespace geodisk
