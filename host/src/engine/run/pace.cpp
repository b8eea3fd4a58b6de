#include "engine/run/pace.hpp"

#include <algorithm>
#include <utility>

#include "constants.h"

namespace geodisk {
namespace {

// Items per step of a lane (several windows and candidates), and per slot (selected and resolved).
constexpr std::uint64_t kItemsPerStep = 16;
constexpr std::uint64_t kItemsPerSlot = 16;
// Steps of a small job, which may all go into one submission.
constexpr double kSmallJob = 1024;
// As many are short on a device 300 times as slow as lavapipe, with all that comes with them.
constexpr double kFewSteps = 160;
// Upper limit of a submission in seconds: the shortest watchdogs allow two.
constexpr double kMaxSeconds = 1;
constexpr std::uint64_t kMaxItems = std::uint64_t{1} << 40;
// Maximum growth from one submission to the next, as long as it stays under half of the target;
// else 2.
constexpr std::uint64_t kLargestGrowth = 4;
// Maximum factor by which a submission may be shorter than the one before.
constexpr double kSteepest = 16;

/// Returns how many items are done in some seconds; all if it is not known how long they take.
std::uint64_t items_in(double seconds, double per_item) {
    const double most =
        per_item > 0 ? std::min(seconds / per_item, static_cast<double>(kMaxItems)) : kMaxItems;
    return static_cast<std::uint64_t>(std::max(most, 1.0));
}

std::uint64_t items_of_step(const RunPlan& plan) {
    const bool by_groups = plan.disks_by == DisksBy::groups;
    // Groups for large disks do as many steps as take the time of those of lanes.
    return (plan.lanes * (by_groups ? gpu::kGroupStepCost : 1) + plan.large_groups) * kItemsPerStep;
}

} // namespace

std::uint64_t Pace::items() const {
    return std::min(items_, items_in(kMaxSeconds, per_item_));
}

void Pace::follow(double seconds, std::uint64_t items) {
    if (seconds < target_ / 2 && items >= items_ / 2) {
        const std::uint64_t times = seconds < target_ / (2 * kLargestGrowth) ? kLargestGrowth : 2;
        items_ = std::min(times * items_, kMaxItems);
    } else if (seconds > target_) {
        const double part = std::max(target_ / seconds, 1 / kSteepest);
        items_ = std::max<std::uint64_t>(
            static_cast<std::uint64_t>(part * static_cast<double>(items_)), 1);
    }
}

void Pace::took(double seconds, std::uint64_t items) {
    follow(seconds, items);
    seconds_ += seconds;
    done_ += static_cast<double>(items);
}

void Pace::took(double seconds, std::uint64_t items, std::uint64_t steps, std::uint32_t lanes) {
    follow(seconds, items);
    if (steps > 0) {
        const double done = static_cast<double>(steps * kItemsPerStep);
        per_item_ = std::max(per_item_ / 2, seconds / done);
        seconds_ += seconds;
        done_ += done;
        lanes_ = lanes;
    }
}

bool Pace::fits(double steps) const {
    return per_item_ > 0 ? steps <= kSmallJob && steps * kItemsPerStep * per_item_ <= kMaxSeconds
                         : steps <= kFewSteps;
}

std::uint64_t Pace::begin_run(std::uint64_t least, std::uint32_t lanes) {
    if (done_ > 0) {
        known_per_item_ = std::exchange(seconds_, 0) / std::exchange(done_, 0);
        known_lanes_ = lanes_;
    }
    // Fewer lanes take as long for their steps as more lanes do side by side.
    const double times = std::max(1.0, static_cast<double>(known_lanes_) / std::max(lanes, 1u));
    per_item_ = known_per_item_ * times;
    const std::uint64_t most =
        per_item_ > 0 ? std::max(items_in(target_, per_item_), least) : least;
    bound(most);
    return most;
}

std::uint64_t items_of_round(const RunPlan& plan) {
    return plan.slots * kItemsPerSlot +
           std::uint64_t{plan.detect_passes} * plan.step_budget * items_of_step(plan);
}

RunPlan shortened(RunPlan plan, const RunPlan& fixed, std::uint64_t pass_items,
                  std::uint64_t round_items) {
    const auto shorten = [](std::uint32_t& field, std::uint32_t given, std::uint64_t most) {
        if (given == 0) {
            field = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(most, 1, field));
        }
    };
    const std::uint64_t steps = round_items / items_of_step(plan);
    shorten(plan.dispatch_items, fixed.dispatch_items, pass_items);
    shorten(plan.detect_passes, fixed.detect_passes, steps / plan.step_budget);
    shorten(plan.step_budget, fixed.step_budget, steps / plan.detect_passes);
    return plan;
}

} // namespace geodisk
