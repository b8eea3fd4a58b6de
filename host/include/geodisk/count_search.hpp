// CountSearch: finds the distance that gives a wanted number of samples.
// Experimental.
#pragma once

#include <cstdint>
#include <optional>

#include <geodisk/export.hpp>

namespace geodisk {

/// Finds the distance by trial. Sample at distance_for_count(), pass the number of samples to
/// note(), and repeat with the distance that it returns. Sample without `stop_count`, or the counts
/// are too low.
///
/// Leads to the same distances on every machine, from the same counts.
class CountSearch {
  public:
    /// Starts a search for about `wanted` samples, at least 1.
    explicit CountSearch(double wanted) noexcept : wanted_(wanted), aim_(wanted) {}
    /// Starts a search for at least `count` samples, not 0, and at most 1 % more. Keep the first
    /// `count` samples of the best try; they keep its distance.
    GEODISK_API static CountSearch exact(std::uint64_t count) noexcept;

    /// Records the number of samples that a distance gave. Returns the distance to try next, or
    /// nothing when the search has ended:
    /// - the count is within 5 % of `wanted` or differs by one; or is as exact() says,
    /// - a larger distance gives no fewer samples; an exact search also ends if a smaller one gives
    ///   no more, and none came out or over 2^17 samples would be expected at the next,
    /// - this was the seventh try. Exact searches end with the sixth, or go on to the twelfth while
    ///   no try has given enough.
    GEODISK_API std::optional<double> note(double distance, std::uint64_t count) noexcept;

    /// Returns true if the latest try is the best so far: the nearest count, or in an exact search
    /// the largest distance with enough samples. No try is the best while all give too few.
    bool is_nearest() const noexcept { return is_nearest_; }
    /// Returns the number of tries so far.
    std::uint32_t tries() const noexcept { return tries_; }

  private:
    struct Try {
        double distance, count;
    };

    /// Takes the count of a try. Returns true if no other try is needed.
    bool ends_with(double distance, double count) noexcept;
    /// Returns the factor on the distance after tries on one side.
    double first_factor(double count) const noexcept;

    double wanted_;
    double aim_;                       ///< Count to steer for, `wanted_` or a little more.
    std::optional<double> max_;        ///< Maximum count of an exact search, which this is then.
    std::optional<Try> above_, below_; ///< Latest tries with too many and too few samples.
    double first_distance_ = 0;        ///< Of the first try, which `wanted_` is expected at.
    double min_miss_ = 0;              ///< Smallest difference from `wanted_` so far.
    double best_distance_ = 0;         ///< Largest distance with enough samples; 0 for none.
    bool is_nearest_ = false;
    bool was_above_ = false; ///< The latest try had too many samples.
    std::uint32_t tries_ = 0;
};

} // namespace geodisk
