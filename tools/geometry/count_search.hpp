// Finds a distance at which there are about as many samples as are wanted, by what others gave.
#pragma once

#include <cstdint>
#include <optional>

namespace geodisk::tools {

class CountSearch {
  public:
    /// Counts are taken to fall with the distance to the power of `dimension`, until they tell.
    CountSearch(double wanted, double dimension) : wanted_(wanted), exponent_(dimension) {}

    /// Notes how many samples a distance gave. Returns the distance to try next; nothing once that
    /// many are within 5 % of those wanted, or one, or several tries have not come so close.
    std::optional<double> note(double distance, std::uint64_t count);

    /// Whether none before the try noted last came nearer.
    bool is_nearest() const noexcept { return is_nearest_; }
    std::uint32_t tries() const noexcept { return tries_; }

  private:
    struct Try {
        double distance, count;
    };

    double wanted_, exponent_;
    std::optional<Try> above_, below_; ///< With more samples, and with fewer: the nearest.
    std::optional<double> least_miss_;
    bool is_nearest_ = false;
    std::uint32_t tries_ = 0;
};

} // namespace geodisk::tools
