// Division of a plan's pool: slices of lanes and work groups for disks in progress, and lists of
// conflicts.
#pragma once

#include <cstdint>

#include <geodisk/sampler.hpp>

namespace geodisk {

/// Returns the plan with as many slots and lanes as fit the pool. If its slices leave room for no
/// lane, or for few work groups, takes smaller ones: a plan estimates them, and disks that overflow
/// get larger ones. Returns no lanes if not even one fits.
RunPlan fitted(RunPlan plan, std::uint64_t pool_bytes);

/// Sets what work groups for large disks get beside lanes, which keep all disks if `lanes_keep`.
void plan_large_disks(RunPlan& plan, bool lanes_keep);

/// Fallback of a grown plan for disks of work groups whose slices do not fit the pool.
enum class LastResort { none, lanes };

/// Returns the plan to use after an overflow: the capacities named by `overflow` (gpu::kOverflow*
/// bits) are doubled, and slots and lanes reduced if the pool would exceed `pool_bytes`. If work
/// groups do not fit then, lanes may compute their disks, slower but in less memory. Errors:
/// `workspace_too_small`, naming the bytes of one lane and one list of conflicts.
Result<RunPlan> grown_plan(const RunPlan& plan, std::uint32_t overflow, std::uint64_t pool_bytes,
                           const DeviceReport& report, LastResort last = LastResort::lanes);

/// Returns the error of a pool too small for one lane of the plan.
Error slice_error(const RunPlan& plan, std::uint64_t pool_bytes);

} // namespace geodisk
