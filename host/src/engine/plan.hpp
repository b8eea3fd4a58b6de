// Plans that a caller changes in part, and what bounds them.
#pragma once

#include <geodisk/sampler.hpp>

namespace geodisk {

/// `plan` with each field of `wanted` that is not zero in place of its own.
GEODISK_API RunPlan overridden(RunPlan plan, const RunPlan& wanted) noexcept;

/// Most steps of detect that one dispatch may safely take.
std::uint32_t most_steps(const DeviceReport& report) noexcept;

} // namespace geodisk
