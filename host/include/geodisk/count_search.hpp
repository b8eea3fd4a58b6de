// CountSearch: finds the distance that gives about a wanted number of samples.
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
    /// Starts a search for `wanted` samples, at least 1.
    explicit CountSearch(double wanted) noexcept : wanted_(wanted) {}

    /// Records the number of samples that a distance gave. Returns the distance to try next, or
    /// nothing when the search has ended: the count is within 5 % of `wanted` or differs by one, a
    /// larger distance gives no fewer samples, or this was the seventh try.
    GEODISK_API std::optional<double> note(double distance, std::uint64_t count) noexcept;

    /// Returns true if the latest try is the best so far.
    bool is_nearest() const noexcept { return is_nearest_; }
    /// Returns the number of tries so far.
    std::uint32_t tries() const noexcept { return tries_; }

  private:
    struct Try {
        double distance, count;
    };

    double wanted_;
    std::optional<Try> above_, below_; ///< Latest tries with too many and too few samples.
    double least_miss_ = 0;            ///< Smallest difference from `wanted_` so far.
    bool is_nearest_ = false;
    std::uint32_t tries_ = 0;
};

} // namespace geodisk
