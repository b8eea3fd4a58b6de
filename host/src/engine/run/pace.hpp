// Pace: amount of work per submission, so that it takes the target time on any device.
#pragma once

#include <algorithm>
#include <cstdint>

#include <geodisk/export.hpp>
#include <geodisk/sampler.hpp>

namespace geodisk {

/// Measures work of one kind in items: faces, candidates or samples visited, or a part of a disk.
/// Starts tiny, then follows the times of submissions. Continues from run to run.
class GEODISK_API Pace {
  public:
    /// Items of the first submission while nothing is known: of passes, and of rounds, whose lanes
    /// may all be busy.
    static constexpr std::uint64_t kFirstItems = std::uint64_t{1} << 14;
    static constexpr std::uint64_t kFirstItemsOfRounds = 2560;

    /// `target` is the length of a submission in seconds.
    explicit Pace(double target) : target_(target) {}

    /// Returns the maximum of items for the next submission.
    std::uint64_t items() const;

    /// Records the time of a submission with at most this many items.
    void took(double seconds, std::uint64_t items);

    /// Records the time of rounds, in which `lanes` lanes took `steps` in all. Rounds mostly do
    /// much less than their maximum of items. The number of items stays so low that the time is
    /// short even if all lanes are busy in all dispatches.
    void took(double seconds, std::uint64_t items, std::uint64_t steps, std::uint32_t lanes);

    /// Returns true if all steps of a small job fit one submission: by the time of earlier ones, or
    /// if there are none, because they are few.
    bool fits(double steps) const;

    /// Limits the next submission, if its work is of another kind.
    void bound(std::uint64_t items) { items_ = std::min(items_, items); }

    /// Begins another run, maybe on another mesh. Limits the first submission to as many items as
    /// took the target in the run before, or `least` if that is more or unknown. Returns this
    /// limit. Counts steps as if all lanes took them all the time, since those of another mesh may.
    std::uint64_t begin_run(std::uint64_t least, std::uint32_t lanes = 1);

  private:
    void follow(double seconds, std::uint64_t items);

    double target_;
    std::uint64_t items_ = kFirstItems;
    double per_item_ = 0; ///< Recent maximum of seconds.
    // In this run.
    double seconds_ = 0;
    double done_ = 0; ///< Items, or what steps are worth.
    std::uint32_t lanes_ = 1;
    // In the run before.
    double known_per_item_ = 0; ///< Average of seconds; 0 if unknown.
    std::uint32_t known_lanes_ = 1;
};

/// Known paces of one kind of kernels.
struct Paces {
    Pace passes, rounds;
};

/// Returns the maximum of items in a round of a plan.
GEODISK_API std::uint64_t items_of_round(const RunPlan& plan);

/// Returns the plan with shorter dispatches: of passes up to so many items, and of rounds so that
/// as many are enough for a round if possible. Fields that are not zero in `fixed` stay.
GEODISK_API RunPlan shortened(RunPlan plan, const RunPlan& fixed, std::uint64_t pass_items,
                              std::uint64_t round_items);

} // namespace geodisk
