// Plans that a caller changes in part, what bounds them, and what plans of all domains share.
#pragma once

#include <string>

#include <geodisk/sampler.hpp>

namespace geodisk {

/// `plan` with each field of `wanted` that is not zero in place of its own.
GEODISK_API RunPlan overridden(RunPlan plan, const RunPlan& wanted) noexcept;

/// Most steps of detect that one dispatch may safely take.
std::uint32_t most_steps(const DeviceReport& report) noexcept;

/// As many slots as the tuning's batches ask for with this many disks, and enough to fill the
/// device.
std::uint32_t wanted_slots(double disks, std::uint32_t batches, const DeviceReport& report);

/// Room for the samples of a run that expects so many, and may stop at `stop_count` unless that is
/// 0: half as many again where the device can bind that.
std::uint32_t wanted_sample_capacity(std::uint32_t candidates, double samples,
                                     std::uint32_t stop_count, const DeviceReport& report);

/// Darts of a chunk, where they may be far more than a pool.
double darts_at_once(double samples, bool may_stop) noexcept;

/// The least power of two that is not less, up to 2^25.
std::uint32_t pow2_at_least(double x);

/// The plan with as many slots and lanes as fit the pool and one binding.
Result<RunPlan> fitted(RunPlan plan, std::uint64_t pool_bytes, const DeviceLimits& limits);

/// What does not depend on the domain; a word per candidate for each of the others.
WorkspaceNeeds needs_of_run(std::uint64_t candidates, std::uint64_t cells, const RunPlan& plan);

/// `device_lacks` when a buffer would exceed what the device can bind; `what` is the job, as "for
/// 100 candidates and 12 faces".
Result<Done> check_needs(const WorkspaceNeeds& needs, const std::string& what,
                         const DeviceReport& report);

} // namespace geodisk
