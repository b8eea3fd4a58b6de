// Plans: division of a job into work, and sizes of its buffers.
#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include <geodisk/sampler.hpp>

#include "bindings.h"
#include "constants.h"
#include "engine/capacity.hpp"
#include "engine/domain/domain_impl.hpp"
#include "engine/job/buffer_ranges.hpp"
#include "engine/job/plan.hpp"
#include "engine/job/pool_plan.hpp"
#include "engine/job/sampler_impl.hpp"
#include "engine/kernels/loop_bounds.hpp"
#include "push.h"
#include "records.h"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// Even with one per work group, there are no more groups than any device allows.
constexpr double kMaxSlots = (1u << 16) - 512;
// Maximum on a CPU: more lists would not fit its caches.
constexpr double kMaxCpuSlots = 1u << 13;
constexpr double kMaxPasses = 32;
// How many times as many slots a CPU has as a batch takes at first, and the maximum of them.
constexpr std::uint32_t kRoom = 4;
constexpr std::uint32_t kMaxRoom = 1u << 11;
// Several milliseconds per dispatch.
constexpr std::uint32_t kCpuDispatchItems = 1u << 19;
constexpr std::uint32_t kDispatchItems = 1u << 21;
// Additional slots of a batch, in square roots of their number, see lib/schedule.glsl.
constexpr double kSlotMargin = 1.5;
// Idle candidates listed at once per slot, and candidates per listed one. More of them mean fewer
// passes over all candidates.
constexpr std::uint32_t kIdlePerSlot = 32;
constexpr std::uint32_t kCandidatesPerIdle = 16;
constexpr std::uint32_t kMinIdle = 4096;

std::uint64_t blocks_of(std::uint64_t words) {
    return (words + gpu::kScanBlock - 1) / gpu::kScanBlock;
}

/// Returns the slots for the number of batches in the tuning and this many disks, but at least as
/// many as fill the device.
// If both are impossible, a CPU should rather wait than compute very many disks in vain.
std::uint32_t wanted_slots(double disks, std::uint32_t batches, const DeviceReport& report) {
    const bool cpu = report.type == VK_PHYSICAL_DEVICE_TYPE_CPU;
    const double least =
        cpu ? std::clamp<double>(disks / 2, kMinSlots, std::max(kMinSlots, cpu_lanes(report))) : 64;
    auto aim = static_cast<std::uint32_t>(
        std::clamp(disks / batches, least, cpu ? kMaxCpuSlots : kMaxSlots));
    // Lanes should not wait for each other at the end of a batch, nor a thread have a few alone.
    const std::uint32_t all = cpu ? cpu_lanes(report) : 1;
    const std::uint32_t lanes = cpu && aim < all ? all / cpu_threads() : all;
    aim = (aim + lanes - 1) / lanes * lanes;
    return aim <= gpu::kMaxRanked ? aim
                                  : aim + static_cast<std::uint32_t>(kSlotMargin * std::sqrt(aim));
}

/// Returns the sample capacity for an expected number, and a `stop_count` unless it is 0: half as
/// many again if the device can bind that, and a batch.
// Borders, creases and thin parts hold more samples than the area suggests. If the device cannot
// bind that many, take as many as possible, but never fewer than expected. A batch begins only if
// there is room for all of it.
std::uint32_t wanted_sample_capacity(double samples, std::uint32_t stop_count, std::uint32_t slots,
                                     const DeviceReport& report) {
    const std::uint64_t most = report.limits.max_storage_buffer_range / sizeof(gpu::SampleRec);
    double capacity = std::ceil(1.5 * samples) + 64;
    capacity = stop_count != 0 ? std::min<double>(capacity, stop_count) : capacity;
    return static_cast<std::uint32_t>(std::min(
        capacity + slots, std::max(static_cast<double>(most), std::ceil(samples) + slots)));
}

/// Returns the number of idle candidates to list at once.
std::uint32_t wanted_idle_capacity(std::uint32_t slots, std::uint32_t capacity) noexcept {
    const std::uint32_t wanted = std::max(kIdlePerSlot * slots, capacity / kCandidatesPerIdle);
    return std::clamp(wanted, kMinIdle, gpu::kMaxListed);
}

/// Returns the plan with slots for larger batches, where the lanes of a CPU compute disks and the
/// pool has room for their lists: other lanes then have work beside a few disks that are much
/// larger than the others.
// A batch of more than half of the samples would compute most disks in vain.
RunPlan with_room(RunPlan plan, const Domain::Impl& of, std::uint64_t pool_bytes,
                  const DeviceReport& report) {
    if (report.type != VK_PHYSICAL_DEVICE_TYPE_CPU || plan.disks_by == DisksBy::groups ||
        of.has_lane_per_slot || of.kernels.records()) {
        return plan;
    }
    RunPlan roomy = plan;
    roomy.batch = plan.slots;
    const std::uint32_t most = plan.slots <= gpu::kMaxRanked ? gpu::kMaxRanked : kMaxRoom;
    const auto half = static_cast<std::uint32_t>(std::min<double>(of.samples / 2, most));
    roomy.slots = std::max(plan.slots, std::min(kRoom * plan.slots, half));
    roomy.sample_capacity += roomy.slots - plan.slots;
    const std::uint64_t bytes = std::uint64_t{roomy.sample_capacity} * sizeof(gpu::SampleRec);
    const bool fits =
        roomy.pool_bytes() <= pool_bytes && bytes <= report.limits.max_storage_buffer_range;
    return fits ? roomy : plan;
}

Result<Done> check_needs(const WorkspaceNeeds& needs, const Domain::Impl& of,
                         std::uint32_t candidates, const DeviceReport& report) {
    const std::uint64_t limit = report.limits.max_storage_buffer_range;
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        const bool of_mesh = i == gpu::kBindFaces || i == gpu::kBindFans;
        if (needs.bytes[i] > limit) {
            return Error{Status::job_too_large,
                         std::string("the buffer ") + of.name_of(static_cast<BufferRole>(i)) +
                             " for " + std::to_string(candidates) + " candidates" +
                             of.beside_candidates() + " takes " + std::to_string(needs.bytes[i]) +
                             " bytes, but " + report.name + " binds at most " +
                             std::to_string(limit) +
                             (of_mesh ? "; give a mesh of fewer faces"
                                      : "; raise the minimum distance, or ask for fewer samples")};
        }
    }
    return Done{};
}

} // namespace

const char* to_string(BufferRole role) noexcept {
    constexpr const char* kNames[kBufferRoles] = {
        "faces",   "fans", "cells", "weights", "orders",   "starts",  "pool",
        "control", "list", "sums",  "samples", "accepted", "buckets", "constants"};
    return kNames[static_cast<std::size_t>(role)];
}

std::uint64_t min_sample_capacity(const gpu::ControlRec& control, std::uint32_t slots) noexcept {
    return std::uint64_t{control.accepted} + slots + 1;
}

RunPlan overridden(RunPlan plan, const RunPlan& wanted) noexcept {
    const auto replace = [](std::uint32_t& field, std::uint32_t value) {
        field = value != 0 ? value : field;
    };
    // A batch needs room for all of its samples.
    plan.sample_capacity += wanted.slots;
    plan.batch = wanted.slots != 0 ? wanted.batch : plan.batch;
    replace(plan.slots, wanted.slots);
    replace(plan.batch, wanted.batch);
    replace(plan.window_capacity, wanted.window_capacity);
    replace(plan.table_capacity, wanted.table_capacity);
    replace(plan.list_capacity, wanted.list_capacity);
    replace(plan.step_budget, wanted.step_budget);
    if (wanted.disks_by != DisksBy::automatic) {
        const bool by_groups = wanted.disks_by == DisksBy::groups;
        plan.lanes = plan.disks_by == wanted.disks_by || by_groups ? plan.lanes : plan.slots;
        plan.pool_block = by_groups ? 1 : plan.pool_block;
        plan.disks_by = wanted.disks_by;
    }
    replace(plan.lanes, wanted.lanes);
    replace(plan.detect_passes, wanted.detect_passes);
    replace(plan.sample_capacity, wanted.sample_capacity);
    replace(plan.pool_block, wanted.pool_block);
    replace(plan.stages, wanted.stages);
    replace(plan.idle_capacity, wanted.idle_capacity);
    replace(plan.dispatch_items, wanted.dispatch_items);
    replace(plan.large_groups, wanted.large_groups);
    replace(plan.large_window_capacity, wanted.large_window_capacity);
    replace(plan.large_table_capacity, wanted.large_table_capacity);
    replace(plan.large_after, wanted.large_after);
    // A disk of a work group begins with several windows.
    if (plan.disks_by == DisksBy::groups) {
        plan.window_capacity = std::max(plan.window_capacity, gpu::kMinGroupWindows);
    }
    plan.large_window_capacity = std::max(plan.large_window_capacity, gpu::kMinGroupWindows);
    plan.trims = plan.trims || wanted.trims;
    plan.error_bound = wanted.error_bound != 0 ? wanted.error_bound : plan.error_bound;
    return plan;
}

VkDeviceSize WorkspaceNeeds::total() const noexcept {
    VkDeviceSize sum = 0;
    for (const VkDeviceSize size : bytes) {
        sum += size;
    }
    return sum;
}

Workspace WorkspaceLayout::in(VkBuffer buffer, VkDeviceSize offset) const noexcept {
    Workspace workspace;
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        if (needs.bytes[i] > 0) {
            workspace[i] = {buffer, offset + offsets[i], needs.bytes[i]};
        }
    }
    return workspace;
}

WorkspaceLayout Sampler::lay_out(const WorkspaceNeeds& needs) const noexcept {
    WorkspaceLayout layout;
    layout.needs = needs;
    layout.alignment = range_alignment(impl_->report.limits);
    RangeCutter cutter(layout.alignment);
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        layout.offsets[i] = cutter.cut(needs.bytes[i]);
    }
    layout.bytes = cutter.end();
    return layout;
}

Result<RunPlan> Sampler::plan_run(const Domain& domain, std::uint64_t pool_bytes) const noexcept {
    return guarded([&]() -> Result<RunPlan> {
        const DeviceReport& report = impl_->report;
        const Domain::Impl& of = Domain::Impl::of(domain);
        RunPlan plan;
        plan.pool_block = tuning().pool_block;
        // Disks that only record are never in vain.
        const std::uint32_t batches = of.kernels.records() ? 1 : tuning().batches;
        plan.slots = wanted_slots(of.samples, batches, report);
        plan.stages = stages_at_once(of.stages, of.max_candidates(report.limits, plan.slots));
        const std::uint32_t candidates = capacity_for(of.stages, plan.stages);
        plan.sample_capacity =
            of.avoided + wanted_sample_capacity(of.samples, of.stop_count, plan.slots, report);
        const auto settled = static_cast<std::uint32_t>(of.settled.size());
        plan.sample_capacity = std::max(plan.sample_capacity, settled + plan.slots + 1);
        plan.idle_capacity = wanted_idle_capacity(plan.slots, candidates);
        plan.dispatch_items =
            report.type == VK_PHYSICAL_DEVICE_TYPE_CPU ? kCpuDispatchItems : kDispatchItems;
        pool_bytes = std::min(pool_bytes, report.limits.max_storage_buffer_range);
        const auto with_disks = [&](DisksBy by) {
            RunPlan with = plan;
            with.disks_by = by;
            of.plan_disks(with, candidates, report);
            return fitted(with, pool_bytes);
        };
        plan = with_disks(DisksBy::automatic);
        if (plan.lanes == 0 && plan.disks_by == DisksBy::groups) {
            plan = with_disks(DisksBy::lanes);
        }
        if (plan.lanes == 0) {
            return slice_error(plan, pool_bytes);
        }
        // A CPU's lanes are as fast as groups, and groups do not record.
        plan_large_disks(plan, report.type == VK_PHYSICAL_DEVICE_TYPE_CPU || of.kernels.records());
        KernelVariant variant = impl_->variant_for(domain);
        variant.groups = plan.disks_by == DisksBy::groups;
        plan.step_budget = max_steps(report, variant);
        plan.detect_passes = static_cast<std::uint32_t>(
            std::clamp(of.detect_passes(plan, candidates), 1.0, kMaxPasses));
        return with_room(plan, of, pool_bytes, report);
    });
}

Result<WorkspaceNeeds> needs_of(const Domain& domain, const RunPlan& plan,
                                const DeviceReport& report) {
    const Domain::Impl& of = Domain::Impl::of(domain);
    if (of.stages.is_counted() && plan.stages > 1) {
        return Error{Status::invalid_argument,
                     "darts are drawn one stage at a time; RunPlan::stages is " +
                         std::to_string(plan.stages) + ", set it to 1"};
    }
    const std::uint32_t candidates = capacity_for(of.stages, plan.stages);
    const std::uint32_t buckets = bucket_count(candidates);
    const std::uint64_t starts = of.units * plan.stages + 1;
    const std::uint64_t cells = of.cells(candidates, plan.error_bound);
    const std::uint64_t ranges = (plan.idle_capacity + gpu::kListRange - 1) / gpu::kListRange;
    WorkspaceNeeds needs;
    needs.bytes[gpu::kBindCells] = cells != 0 ? (cells + 2) * 4 : 0;
    needs.bytes[gpu::kBindOrders] = (candidates + state_words(candidates)) * 4;
    needs.bytes[gpu::kBindStarts] = starts * 4;
    needs.bytes[gpu::kBindPool] = plan.pool_bytes();
    needs.bytes[gpu::kBindControl] =
        sizeof(gpu::ControlRec) + std::uint64_t{plan.slots} * sizeof(gpu::SlotRec);
    needs.bytes[gpu::kBindList] = ranges * (gpu::kListRange + 1) * 4;
    needs.bytes[gpu::kBindSums] =
        blocks_of(std::max({starts, cells + 2, std::uint64_t{buckets} + 2})) * 4;
    needs.bytes[gpu::kBindConstants] = (sizeof(gpu::JobRec) + 15) / 16 * 16; // As std140 pads it.
    const auto samples = sample_bytes(plan.sample_capacity, buckets);
    needs.bytes[gpu::kBindSamples] = samples[0];
    needs.bytes[gpu::kBindAccepted] = samples[1];
    needs.bytes[gpu::kBindBuckets] = samples[2];
    of.add_needs(needs, candidates, plan);
    GEODISK_TRY(check_needs(needs, of, candidates, report));
    return needs;
}

Result<WorkspaceNeeds> Sampler::workspace_needs(const Domain& domain, const RunPlan& plan,
                                                std::uint32_t regrowths) const noexcept {
    return guarded([&]() -> Result<WorkspaceNeeds> {
        constexpr std::uint32_t kAll =
            gpu::kOverflowWindows | gpu::kOverflowVertices | gpu::kOverflowConflicts;
        RunPlan larger = plan;
        for (std::uint32_t i = 0; i < regrowths; ++i) {
            const auto grown =
                grown_plan(larger, kAll, ~std::uint64_t{0}, impl_->report, LastResort::none);
            GEODISK_TRY(grown);
            larger = *grown;
            larger.sample_capacity += std::min(larger.sample_capacity / 2, ~larger.sample_capacity);
        }
        return needs_of(domain, larger, impl_->report);
    });
}

} // namespace geodisk
