#include "engine/run/pace.hpp"

#include <algorithm>

namespace geodisk {
namespace {

// Items per step of a lane (several windows and candidates), and per slot (selected and resolved).
constexpr std::uint64_t kItemsPerStep = 16;
constexpr std::uint64_t kItemsPerSlot = 16;
// Upper limit of a submission in seconds: the shortest watchdogs allow two.
constexpr double kMostSeconds = 1;
constexpr std::uint64_t kMostItems = std::uint64_t{1} << 40;
// Maximum growth from one submission to the next, as long as it stays under half of the target;
// else 2.
constexpr std::uint64_t kLargestGrowth = 4;
// Maximum factor by which a submission may be shorter than the one before.
constexpr double kSteepest = 16;

std::uint64_t items_of_step(const RunPlan& plan) {
    return plan.lanes * kItemsPerStep;
}

} // namespace

std::uint64_t Pace::items() const {
    const double most =
        per_step_ > 0 ? kMostSeconds / per_step_ * kItemsPerStep : static_cast<double>(kMostItems);
    return std::min(items_, static_cast<std::uint64_t>(std::max(most, 1.0)));
}

void Pace::took(double seconds, std::uint64_t items, std::uint64_t steps) {
    if (seconds < target_ / 2 && items >= items_ / 2) {
        const std::uint64_t times = seconds < target_ / (2 * kLargestGrowth) ? kLargestGrowth : 2;
        items_ = std::min(times * items_, kMostItems);
    } else if (seconds > target_) {
        const double part = std::max(target_ / seconds, 1 / kSteepest);
        items_ = std::max<std::uint64_t>(
            static_cast<std::uint64_t>(part * static_cast<double>(items_)), 1);
    }
    if (steps > 0) {
        per_step_ = std::max(per_step_ / 2, seconds / static_cast<double>(steps));
    }
}

std::uint64_t items_of_round(const RunPlan& plan) {
    return plan.slots * kItemsPerSlot +
           std::uint64_t{plan.detect_passes} * plan.step_budget * items_of_step(plan);
}

RunPlan shortened(RunPlan plan, const RunPlan& fixed, std::uint64_t items) {
    const auto shorten = [items](std::uint32_t& field, std::uint32_t given, std::uint64_t each) {
        if (given == 0) {
            field = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(items / each, 1, field));
        }
    };
    shorten(plan.dispatch_items, fixed.dispatch_items, 1);
    shorten(plan.detect_passes, fixed.detect_passes, items_of_step(plan) * plan.step_budget);
    shorten(plan.step_budget, fixed.step_budget, items_of_step(plan) * plan.detect_passes);
    return plan;
}

} // namespace geodisk
