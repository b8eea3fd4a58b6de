// Growth of jobs that outgrow their memory between frames, shared by FrameSampler and
// FrameNeighbours.
#pragma once

#include <cstdint>

#include <geodisk/sampler.hpp>

#include "records.h"

namespace geodisk {

/// Maximum of command buffers in flight.
inline constexpr std::uint32_t kMaxFrames = 16;

/// Next step of a job.
struct FrameAdvice {
    Advice advice;
    /// Disks need a larger pool than the job has: advice.plan is for that. Make a job of it.
    bool outgrown = false;
};

/// Returns the next step of a job by its control record. Doubles `pool_bytes` until disks that have
/// outgrown the pool fit, as far as one binding of the device allows. Errors: those of
/// Job::advance().
Result<FrameAdvice> advance_or_grow(Job& job, const gpu::ControlRec& control,
                                    std::uint64_t& pool_bytes, const DeviceReport& report);

} // namespace geodisk
