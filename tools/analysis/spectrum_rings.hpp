// Averages of a power spectrum over frequencies of about equal length.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace geodisk::tools::analysis {

/// Frequencies of about equal length.
struct SpectrumRing {
    double frequency; ///< The middle, in waves per unit of length.
    std::uint32_t count;
    double mean;       ///< Mean of the power, the radial mean.
    double anisotropy; ///< Its variance over its squared mean, of the power averaged over sets.
};

/// Over all frequencies of the rings.
double mean_anisotropy(std::span<const SpectrumRing> rings);

/// Ten times the logarithm; of no ratio that of a very small one.
double decibels(double ratio);

/// Adds powers up, each to its ring.
class RingSums {
  public:
    /// Rings are `width` wide, from frequency 0 to `highest`; both positive.
    RingSums(double width, double highest);

    /// Adds power at a frequency. Ignores frequencies beyond the highest.
    void add(double frequency, double power);

    /// Those of at least two frequencies, as fewer have no variance.
    std::vector<SpectrumRing> rings() const;

  private:
    struct Sums {
        double count = 0, powers = 0, squares = 0;
    };
    double width_, highest_;
    std::vector<Sums> sums_;
};

} // namespace geodisk::tools::analysis
