#include "engine/job/job_checks.hpp"

#include <bit>
#include <cmath>
#include <string>

#include "bindings.h"
#include "constants.h"
#include "engine/domain/domain_impl.hpp"
#include "engine/job/buffer_ranges.hpp"
#include "records.h"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// Maximum error, as a fraction of a minimum distance.
constexpr double kMaxError = 0.5;

/// Checks that a buffer of a workspace is usable beside the first `others` buffers of it.
Result<Done> check_buffer(const Workspace& workspace, std::size_t role, VkDeviceSize needed,
                          std::size_t others, const auto& name, const Sampler::Impl& sampler) {
    GEODISK_TRY(check_range(workspace[role], name(role), needed, sampler));
    for (std::size_t k = 0; k < others; ++k) {
        if (k != role && overlap(workspace[role], workspace[k])) {
            return overlap_error(name(role), name(k));
        }
    }
    return Done{};
}

/// Returns true if work groups for large disks have slices of possible sizes.
bool has_large_slices(const RunPlan& plan) {
    constexpr std::uint32_t kMax = 1u << gpu::kMaxLevels;
    return plan.large_groups <= kMax && plan.large_window_capacity >= gpu::kMinGroupWindows &&
           std::has_single_bit(plan.large_window_capacity) &&
           std::has_single_bit(plan.large_table_capacity) && plan.large_window_capacity <= kMax &&
           plan.large_table_capacity <= kMax;
}

} // namespace

Result<Done> check_workspace(const Workspace& workspace, const WorkspaceNeeds& needs,
                             const Domain::Impl& of, const Sampler::Impl& sampler) {
    const auto name = [&of](std::size_t i) { return of.name_of(static_cast<BufferRole>(i)); };
    for (std::size_t i = 0; i < kBufferRoles; ++i) {
        if (needs.bytes[i] == 0) {
            continue;
        }
        GEODISK_TRY(check_buffer(workspace, i, needs.bytes[i], i, name, sampler));
    }
    return Done{};
}

Result<Done> check_replacement(const Workspace& workspace, std::size_t role, VkDeviceSize needed,
                               const Sampler::Impl& sampler) {
    const auto name = [](std::size_t i) { return to_string(static_cast<BufferRole>(i)); };
    return check_buffer(workspace, role, needed, kBufferRoles, name, sampler);
}

Result<Done> check_plan(const RunPlan& plan, const Tuning& tuning) {
    constexpr std::uint32_t kMax = 1u << gpu::kMaxLevels;
    const std::uint32_t min_windows = plan.disks_by == DisksBy::groups ? gpu::kMinGroupWindows : 2;
    const bool fine =
        plan.slots >= kMinSlots && plan.window_capacity >= min_windows &&
        std::has_single_bit(plan.window_capacity) && std::has_single_bit(plan.table_capacity) &&
        plan.list_capacity >= 4 && plan.list_capacity % 4 == 0 && plan.lanes >= 1 &&
        plan.lanes <= kMax && plan.step_budget >= 1 && plan.detect_passes >= 1 &&
        plan.dispatch_items >= 1 && plan.detect_passes <= 4096 &&
        plan.sample_capacity > plan.slots && plan.stages >= 1 && plan.stages <= gpu::kMaxStages &&
        plan.idle_capacity >= 1 && plan.idle_capacity <= gpu::kMaxListed && plan.slots <= kMax &&
        plan.window_capacity <= kMax && plan.table_capacity <= kMax && plan.list_capacity <= kMax &&
        (plan.large_groups == 0 || has_large_slices(plan));
    if (!fine) {
        return Error{
            Status::invalid_argument,
            "the plan is not as RunPlan asks: slots at least 8, lanes, step_budget, "
            "detect_passes, stages, idle_capacity and dispatch_items at least 1, stages "
            "at most 15, sample_capacity more than slots, window_capacity and table_capacity "
            "powers of two, window_capacity at least 2, or 4 by groups, list_capacity a "
            "multiple of 4, idle_capacity at most 2^23, large_window_capacity and "
            "large_table_capacity as those of groups if there are large_groups, none of them "
            "0 or more than 2^26"};
    }
    // The vertex table tags distances by the bits that those below 2 leave clear.
    if (!(plan.error_bound > 0 && plan.error_bound <= kMaxError)) {
        return Error{Status::invalid_argument,
                     "the plan's error_bound of " + number_text(plan.error_bound) +
                         " is not above 0 and at most half of the minimum distance"};
    }
    const std::uint64_t max_slots = std::uint64_t{kMaxGroups} * tuning.slot_local_size;
    if (plan.slots > max_slots) {
        return Error{Status::invalid_argument,
                     "the plan's " + std::to_string(plan.slots) + " slots are more than the " +
                         std::to_string(max_slots) + " that work groups of " +
                         std::to_string(tuning.slot_local_size) + " reach"};
    }
    if (plan.pool_block != tuning.pool_block && plan.pool_block != 1) {
        return Error{Status::invalid_argument, "the plan's pool_block is " +
                                                   std::to_string(plan.pool_block) +
                                                   ", which is neither 1 nor the sampler's " +
                                                   std::to_string(tuning.pool_block)};
    }
    return Done{};
}

Result<Done> check_plan(const RunPlan& plan, const Job::Impl& job, VkDeviceSize pool) {
    GEODISK_TRY(check_plan(plan, job.sampler->choices.tuning));
    if (plan.stages != job.plan.stages || plan.idle_capacity != job.plan.idle_capacity ||
        plan.sample_capacity != job.plan.sample_capacity ||
        plan.error_bound != job.plan.error_bound) {
        return Error{Status::invalid_argument,
                     "the plan has another error_bound, or other stages, idle_capacity or "
                     "sample_capacity than the job was made for"};
    }
    const std::uint32_t max_slots = job.max_slots;
    if (plan.pool_bytes() > pool || plan.slots > max_slots) {
        return Error{Status::workspace_too_small,
                     "the plan needs a pool of " + std::to_string(plan.pool_bytes()) +
                         " bytes and " + std::to_string(plan.slots) + " slots; the workspace has " +
                         std::to_string(pool) + " bytes and " + std::to_string(max_slots) +
                         " slots"};
    }
    return Done{};
}

Error too_many_existing(std::size_t samples, const RunPlan& plan) {
    return {Status::invalid_argument,
            std::to_string(samples) + " existing samples are more than the plan's " +
                "sample_capacity of " + std::to_string(plan.sample_capacity)};
}

Result<Done> check_existing_records(std::span<const gpu::SampleRec> samples, const Job::Impl& job) {
    if (samples.size() > job.plan.sample_capacity) {
        return too_many_existing(samples.size(), job.plan);
    }
    const bool has_weights = job.variant.domain != DomainKind::box;
    // Multiples of 2^-24, so that the weight of the first corner is exact.
    const auto is_weight = [](float weight) {
        return weight >= 0 && weight <= 1 && weight * 0x1p24f == std::floor(weight * 0x1p24f);
    };
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const gpu::SampleRec& sample = samples[i];
        if (sample.face >= job.constants.faces) {
            return Error{Status::invalid_argument,
                         "existing sample " + std::to_string(i) + " is in " +
                             (has_weights ? "face " : "cell ") + std::to_string(sample.face) +
                             ", but there are " + std::to_string(job.constants.faces)};
        }
        if (const std::uint32_t own = sample.order & gpu::kClassMask;
            job.classes != 0 && own >= job.classes) {
            return Error{Status::invalid_argument, "existing sample " + std::to_string(i) +
                                                       " has class " + std::to_string(own) +
                                                       ", but there are " +
                                                       std::to_string(job.classes)};
        }
        if (has_weights && !(is_weight(sample.weight1) && is_weight(sample.weight2) &&
                             sample.weight1 + sample.weight2 <= 1)) {
            return Error{Status::invalid_argument,
                         "the weights of existing sample " + std::to_string(i) +
                             " are not multiples of 2^-24 that sum to at most 1"};
        }
    }
    return Done{};
}

} // namespace geodisk
