// How much work a submission gets, so that it takes about the time it should, on any device.
#pragma once

#include <algorithm>
#include <cstdint>

#include <geodisk/export.hpp>
#include <geodisk/sampler.hpp>

namespace geodisk {

/// Counts work of one kind in items: faces, candidates or samples gone through, or a part of a
/// disk. Starts tiny; grows and shrinks by what submissions took.
class GEODISK_API Pace {
  public:
    /// Seconds that a submission is to take.
    explicit Pace(double target) : target_(target) {}

    /// That the next submission may go through.
    std::uint64_t items() const;

    /// A submission that might have gone through so many items took so long. Rounds mostly do
    /// little of what they might: where lanes took `steps` in them, no more items come than would
    /// still be a short time if all lanes were busy in all dispatches.
    void took(double seconds, std::uint64_t items, std::uint64_t steps = 0);

    /// Bounds the next submission: its work is of another kind than that before.
    void bound(std::uint64_t items) { items_ = std::min(items_, items); }

  private:
    double target_;
    std::uint64_t items_ = 1u << 14;
    double per_step_ = 0; ///< Seconds, at worst, of late.
};

/// What rounds of a plan may take at worst, in items.
GEODISK_API std::uint64_t items_of_round(const RunPlan& plan);

/// The plan with dispatches so short that so many items are enough for a round, if any may be.
/// Fields that are not zero in `fixed` stay.
GEODISK_API RunPlan shortened(RunPlan plan, const RunPlan& fixed, std::uint64_t items);

} // namespace geodisk
