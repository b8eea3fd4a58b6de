// Plans that a caller changes in part, and what plans of all domains share.
#pragma once

#include <array>

#include <geodisk/sampler.hpp>

#include "engine/tolerances.hpp"

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

/// Words of the buffer of states before the weights of a surface's candidates, see lib/states.glsl.
std::uint64_t state_words(std::uint32_t candidates) noexcept;

/// Ranges of orders by which samples are put in order, a power of two.
std::uint32_t bucket_count(std::uint32_t capacity) noexcept;

/// Bytes of samples, accepted and buckets.
std::array<VkDeviceSize, 3> sample_bytes(std::uint32_t capacity, std::uint32_t buckets) noexcept;

/// Room that a run needs to go on: for the samples so far and all of a batch.
std::uint64_t least_sample_capacity(const gpu::ControlRec& control, std::uint32_t slots) noexcept;

/// Invocations that a CPU runs at a time.
std::uint32_t cpu_lanes(const DeviceReport& report);

/// Not more samples than are asked for, or thrown, unless those are 0.
double samples_to_expect(double full, std::uint32_t throws, std::uint32_t stop_count) noexcept;

/// The least power of two that is not less, up to 2^25.
std::uint32_t pow2_at_least(double x);

} // namespace geodisk
