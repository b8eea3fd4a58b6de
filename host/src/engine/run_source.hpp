// What a run samples, whichever the domain.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <geodisk/sampler.hpp>

namespace geodisk {

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

} // namespace geodisk
