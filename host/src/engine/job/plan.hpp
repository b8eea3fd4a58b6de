// Plans that a caller changes in part, and what plans of all domains share.
#pragma once

#include <geodisk/sampler.hpp>

#include "engine/domain/tolerances.hpp"

namespace geodisk {

/// `plan` with each field of `wanted` that is not zero in place of its own.
GEODISK_API RunPlan overridden(RunPlan plan, const RunPlan& wanted) noexcept;

/// As Sampler::grow_plan.
Result<RunPlan> grown_plan(const RunPlan& plan, std::uint32_t overflow, std::uint64_t pool_bytes,
                           const DeviceReport& report);

/// As Sampler::workspace_needs.
Result<WorkspaceNeeds> needs_of(const Domain& domain, const RunPlan& plan,
                                const DeviceReport& report);

/// As Sampler::widen_plan.
RunPlan widened(RunPlan plan, const ErrorModel& error, std::uint32_t longest_chain);

/// Room that a run needs to go on: for the samples so far and all of a batch.
std::uint64_t least_sample_capacity(const gpu::ControlRec& control, std::uint32_t slots) noexcept;

} // namespace geodisk
