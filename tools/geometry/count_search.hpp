// Finds a distance at which there are about as many samples as are wanted, by what others gave.
#pragma once

#include <cstdint>
#include <optional>

namespace geodisk::tools {

class CountSearch {
  public:
    explicit CountSearch(double wanted) : wanted_(wanted) {}

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

    double wanted_;
    std::optional<Try> above_, below_; ///< With more samples, and with fewer: the nearest.
    double least_miss_ = 0;
    bool is_nearest_ = false;
    std::uint32_t tries_ = 0;
};

} // namespace geodisk::tools
