// Functions on plans that all domains share.
#pragma once

#include <geodisk/sampler.hpp>

namespace geodisk {

/// Returns `plan` with every field that is not zero in `wanted` replaced.
GEODISK_API RunPlan overridden(RunPlan plan, const RunPlan& wanted) noexcept;

/// Implements Sampler::workspace_needs.
Result<WorkspaceNeeds> needs_of(const Domain& domain, const RunPlan& plan,
                                const DeviceReport& report);

/// Returns the sample capacity that a run needs to continue: the samples so far and all of a batch.
std::uint64_t min_sample_capacity(const gpu::ControlRec& control, std::uint32_t slots) noexcept;

} // namespace geodisk
