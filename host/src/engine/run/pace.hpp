// Pace: amount of work per submission, so that it takes the target time on any device.
#pragma once

#include <algorithm>
#include <cstdint>

#include <geodisk/export.hpp>
#include <geodisk/sampler.hpp>

namespace geodisk {

/// Measures work of one kind in items: faces, candidates or samples visited, or a part of a disk.
/// Starts tiny, then follows the times of submissions.
class GEODISK_API Pace {
  public:
    /// `target` is the length of a submission in seconds.
    explicit Pace(double target) : target_(target) {}

    /// Returns the maximum of items for the next submission.
    std::uint64_t items() const;

    /// Records the time of a submission with at most this many items. Rounds mostly do much less
    /// than their maximum. If lanes took `steps`, the number of items stays so low that the time is
    /// short even if all lanes are busy in all dispatches.
    void took(double seconds, std::uint64_t items, std::uint64_t steps = 0);

    /// Limits the next submission, if its work is of another kind.
    void bound(std::uint64_t items) { items_ = std::min(items_, items); }

  private:
    double target_;
    std::uint64_t items_ = 1u << 14;
    double per_step_ = 0; ///< Recent maximum of seconds per step.
};

/// Returns the maximum of items in a round of a plan.
GEODISK_API std::uint64_t items_of_round(const RunPlan& plan);

/// Returns the plan with shorter dispatches, so that this many items are enough for a round if
/// possible. Fields that are not zero in `fixed` stay.
GEODISK_API RunPlan shortened(RunPlan plan, const RunPlan& fixed, std::uint64_t items);

} // namespace geodisk
