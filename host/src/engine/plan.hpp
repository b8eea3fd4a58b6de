// Plans that a caller changes in part.
#pragma once

#include <geodisk/sampler.hpp>

namespace geodisk {

/// `plan` with each field of `wanted` that is not zero in place of its own.
GEODISK_API RunPlan overridden(RunPlan plan, const RunPlan& wanted) noexcept;

} // namespace geodisk
