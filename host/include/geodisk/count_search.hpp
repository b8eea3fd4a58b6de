// Finding the distance at which about as many samples as are wanted come out.
#pragma once

#include <cstdint>
#include <optional>

#include <geodisk/export.hpp>

namespace geodisk {

/// Chooses distances to try by what those before gave, beginning with distance_for_count(). The
/// same counts lead to the same distances on every machine. Sample without `stop_count` while the
/// search goes on: it cannot see what that cuts off.
class CountSearch {
  public:
    /// `wanted` samples, at least 1.
    explicit CountSearch(double wanted) noexcept : wanted_(wanted) {}

    /// Notes how many samples a distance gave. Returns the distance to try next; nothing once that
    /// many are within 5 % of those wanted, or one, or several tries have not come so close.
    GEODISK_API std::optional<double> note(double distance, std::uint64_t count) noexcept;

    /// Whether none before the try noted last came nearer.
    bool is_nearest() const noexcept { return is_nearest_; }
    std::uint32_t tries() const noexcept { return tries_; }

  private:
    struct Try {
        double distance, count;
    };

    double wanted_;
    std::optional<Try> above_, below_; ///< With more samples, and with fewer: the nearest.
    double least_miss_ = 0;
    bool is_nearest_ = false;
    std::uint32_t tries_ = 0;
};

} // namespace geodisk
