#include "engine/job/pool_plan.hpp"

#include <algorithm>
#include <string>

#include "constants.h"
#include "records.h"

namespace geodisk {
namespace {

constexpr std::uint32_t kLargestCapacity = 1u << gpu::kMaxLevels;
// Work groups beside lanes for large disks, and what one of them holds at first. A lane leaves a
// disk to them after so many windows, since others wait for it.
constexpr std::uint32_t kLargeGroups = 16;
constexpr std::uint32_t kLargeWindows = 4096;
constexpr std::uint32_t kLargeVertices = 8192;
constexpr std::uint32_t kLargeAfter = 2048;
constexpr std::uint32_t kKeepsAll = ~std::uint32_t{0};
// Work groups that are to fit the pool, so that a wide device is not idle.
constexpr std::uint32_t kEnoughGroups = 16;
// Windows that a slice holds at first even if few fit the pool. Those that wait are about those on
// the edge of a disk.
constexpr std::uint32_t kFirstWindows = 4096;
// Table rows are estimated amply.
constexpr std::uint32_t kAmpleRows = 4;

/// Returns the rows of a work group's slice, see shaders/lib/group.glsl.
std::uint32_t group_rows(std::uint32_t windows, std::uint32_t vertices) {
    return gpu::kGroupRows + (2 * gpu::kItemRows + 6) * windows + gpu::kGroupVertexRows * vertices +
           (vertices / 2 + 3) / 4;
}

/// Returns the bytes of the smallest pool for the plan: the minimum of lists and a block of lanes.
std::uint64_t min_pool(const RunPlan& plan) {
    return std::uint64_t{plan.pool_block} * plan.lane_rows() * 16 +
           std::uint64_t{kMinSlots} * plan.list_capacity * 4;
}

/// Fits slots and lanes to the pool. Work groups for large disks get at most half of it, but one at
/// least. Then it gets the minimum of lists and a block of lanes, then lists for the slots in at
/// most half of the rest. Falls back to blocks of one lane if no larger block fits, and to no lanes
/// if not even one fits.
void fit(RunPlan& plan, std::uint64_t pool_bytes) {
    if (plan.large_groups > 0) {
        const std::uint64_t slice = std::uint64_t{plan.large_rows()} * 16;
        plan.large_groups = static_cast<std::uint32_t>(
            std::clamp<std::uint64_t>(pool_bytes / 2 / slice, 1, plan.large_groups));
        pool_bytes -= std::min(pool_bytes, plan.large_groups * slice);
    }
    if (pool_bytes < min_pool(plan)) {
        plan.pool_block = 1;
    }
    if (pool_bytes < min_pool(plan)) {
        plan.lanes = 0;
        return;
    }
    const std::uint64_t block = std::uint64_t{plan.pool_block} * plan.lane_rows() * 16;
    const std::uint64_t list = std::uint64_t{plan.list_capacity} * 4;
    const std::uint64_t for_lists = std::min(pool_bytes / 2, pool_bytes - block);
    plan.slots = static_cast<std::uint32_t>(
        std::clamp<std::uint64_t>(for_lists / list, kMinSlots, std::max(kMinSlots, plan.slots)));
    const std::uint64_t blocks = (pool_bytes - plan.slots * list) / block;
    plan.lanes = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(std::min(plan.lanes, plan.slots), blocks * plan.pool_block));
}

/// Returns the plan where lanes compute all disks. Their slices are smaller than those of groups,
/// whose windows had this capacity.
RunPlan by_lanes(RunPlan plan, std::uint32_t window_capacity) {
    if (plan.disks_by == DisksBy::groups) {
        plan.lanes = plan.slots;
        plan.window_capacity = window_capacity;
        plan.disks_by = DisksBy::lanes;
    }
    plan.large_groups = 0;
    plan.large_after = kKeepsAll;
    return plan;
}

/// Changes the plan for a disk of very many windows. Where lanes are to leave it to work groups,
/// there are some from now on. If there are, or lanes keep it, or all are computed by groups, the
/// disk must be trimmed, which lanes do.
void provide_for_large(RunPlan& plan) {
    if (plan.disks_by == DisksBy::lanes && plan.large_groups == 0 &&
        plan.large_after != kKeepsAll) {
        plan.large_groups = kLargeGroups;
        return;
    }
    plan = by_lanes(plan, plan.window_capacity);
    plan.trims = true;
}

} // namespace

std::uint32_t RunPlan::batch_slots() const noexcept {
    return batch == 0 ? slots : std::min(batch, slots);
}

std::uint32_t RunPlan::lane_rows() const noexcept {
    if (disks_by == DisksBy::groups) {
        return group_rows(window_capacity, table_capacity);
    }
    return gpu::kLaneRows + (gpu::kWindowRows + 1) * window_capacity + table_capacity +
           (trims ? gpu::kTrimRows + (window_capacity + 3) / 4 : 0);
}

std::uint32_t RunPlan::large_rows() const noexcept {
    return large_groups > 0 ? group_rows(large_window_capacity, large_table_capacity) : 0;
}

std::uint64_t RunPlan::first_large_row() const noexcept {
    const std::uint64_t block = std::max(pool_block, 1u);
    return (lanes + block - 1) / block * block * lane_rows();
}

std::uint64_t RunPlan::first_list_row() const noexcept {
    return first_large_row() + std::uint64_t{large_groups} * large_rows();
}

std::uint64_t RunPlan::pool_bytes() const noexcept {
    return first_list_row() * 16 + std::uint64_t{slots} * list_capacity * 4;
}

RunPlan fitted(RunPlan plan, std::uint64_t pool_bytes) {
    const std::uint32_t enough =
        plan.disks_by == DisksBy::groups ? std::min(plan.lanes, kEnoughGroups) : 1;
    const std::uint32_t min_rows = plan.table_capacity / kAmpleRows;
    for (;;) {
        RunPlan fitting = plan;
        fit(fitting, pool_bytes);
        if (fitting.lanes < enough && plan.window_capacity > kFirstWindows) {
            plan.window_capacity /= 2;
        } else if (fitting.lanes == 0 && plan.table_capacity > std::max(min_rows, 1u)) {
            plan.table_capacity /= 2;
        } else {
            return fitting;
        }
    }
}

void plan_large_disks(RunPlan& plan, bool lanes_keep) {
    plan.large_window_capacity = std::max(kLargeWindows, 2 * plan.window_capacity);
    plan.large_table_capacity = std::max(kLargeVertices, 2 * plan.table_capacity);
    plan.large_after = lanes_keep ? kKeepsAll : kLargeAfter;
}

Result<RunPlan> grown_plan(const RunPlan& plan, std::uint32_t overflow, std::uint64_t pool_bytes,
                           const DeviceReport& report, LastResort last) {
    RunPlan grown = plan;
    const auto grow = [overflow](std::uint32_t bit, std::uint32_t& capacity) {
        capacity = (overflow & bit) != 0 ? std::min(2 * capacity, kLargestCapacity) : capacity;
    };
    grow(gpu::kOverflowWindows, grown.window_capacity);
    grow(gpu::kOverflowVertices, grown.table_capacity);
    grow(gpu::kOverflowConflicts, grown.list_capacity);
    grow(gpu::kOverflowWindows << gpu::kOverflowLargeShift, grown.large_window_capacity);
    grow(gpu::kOverflowVertices << gpu::kOverflowLargeShift, grown.large_table_capacity);
    if ((overflow & gpu::kOverflowTrims) != 0) {
        provide_for_large(grown);
    }
    pool_bytes = std::min(pool_bytes, report.limits.max_storage_buffer_range);
    const bool groups_apart = grown.disks_by == DisksBy::groups || grown.large_groups > 0;
    RunPlan lanes_alone = by_lanes(grown, plan.window_capacity);
    fit(grown, pool_bytes);
    if (grown.lanes == 0 && groups_apart && last == LastResort::lanes) {
        fit(lanes_alone, pool_bytes);
        grown = lanes_alone;
    }
    const bool same = grown.lane_rows() == plan.lane_rows() &&
                      grown.large_rows() == plan.large_rows() &&
                      grown.list_capacity == plan.list_capacity;
    if (grown.lanes == 0 || same) {
        return slice_error(grown, pool_bytes);
    }
    return grown;
}

Error slice_error(const RunPlan& plan, std::uint64_t pool_bytes) {
    return Error{
        Status::workspace_too_small,
        "the disk of one candidate takes " + std::to_string(std::uint64_t{plan.lane_rows()} * 16) +
            " bytes of the pool and each of the least " + std::to_string(kMinSlots) +
            " lists of conflicts " + std::to_string(std::uint64_t{plan.list_capacity} * 4) +
            ", but the pool may take only " + std::to_string(pool_bytes)};
}

} // namespace geodisk
