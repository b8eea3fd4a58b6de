// Plans that a caller changes in part, what bounds them, and what plans of all domains share.
#pragma once

#include <array>
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
/// 0: half as many again where the device can bind that, and a batch.
std::uint32_t wanted_sample_capacity(double samples, std::uint32_t stop_count, std::uint32_t slots,
                                     const DeviceReport& report);

/// Idle candidates to list at once.
std::uint32_t wanted_idle_capacity(std::uint32_t slots, std::uint32_t capacity) noexcept;

/// Candidates to make room for, where so many stages are drawn at once.
std::uint32_t capacity_for(const Stages& stages, std::uint32_t at_once) noexcept;

/// As many stages as so many candidates allow; at least one.
std::uint32_t stages_at_once(const Stages& stages, std::uint64_t most_candidates) noexcept;

/// Ranges of orders by which samples are put in order, a power of two.
std::uint32_t bucket_count(std::uint32_t capacity) noexcept;

/// Bytes of samples, accepted and buckets.
std::array<VkDeviceSize, 3> sample_bytes(std::uint32_t capacity, std::uint32_t buckets) noexcept;

/// The least power of two that is not less, up to 2^25.
std::uint32_t pow2_at_least(double x);

/// The plan with as many slots and lanes as fit the pool and one binding.
Result<RunPlan> fitted(RunPlan plan, std::uint64_t pool_bytes, const DeviceLimits& limits);

/// What does not depend on the domain. No `cells` where their table is that of the units' starts.
WorkspaceNeeds needs_of_run(std::uint64_t capacity, std::uint64_t units, std::uint64_t cells,
                            const RunPlan& plan);

/// `device_lacks` when a buffer would exceed what the device can bind; `what` is the job, as "for
/// 100 candidates and 12 faces".
Result<Done> check_needs(const WorkspaceNeeds& needs, const std::string& what,
                         const DeviceReport& report);

} // namespace geodisk
