// Functions on plans that all domains share.
#pragma once

#include <geodisk/sampler.hpp>

#include "engine/domain/tolerances.hpp"

namespace geodisk {

/// Returns `plan` with every field that is not zero in `wanted` replaced.
GEODISK_API RunPlan overridden(RunPlan plan, const RunPlan& wanted) noexcept;

/// Implements Sampler::grow_plan.
Result<RunPlan> grown_plan(const RunPlan& plan, std::uint32_t overflow, std::uint64_t pool_bytes,
                           const DeviceReport& report);

/// Implements Sampler::workspace_needs.
Result<WorkspaceNeeds> needs_of(const Domain& domain, const RunPlan& plan,
                                const DeviceReport& report);

/// Implements Sampler::widen_plan.
RunPlan widened(RunPlan plan, const ErrorModel& error, std::uint32_t longest_chain);

/// Returns the sample capacity that a run needs to continue: the samples so far and all of a batch.
std::uint64_t least_sample_capacity(const gpu::ControlRec& control, std::uint32_t slots) noexcept;

} // namespace geodisk
