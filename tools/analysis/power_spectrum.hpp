// Power spectra of samples in boxes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/box.hpp>

#include "analysis/spectrum_rings.hpp"
#include "program/batches.hpp"

namespace geodisk::tools::analysis {

/// The periodogram |sum over samples of exp(-2 pi i f x)|^2 / N at all frequencies that a periodic
/// box has, whole numbers of waves along each side, without the mean; the average over sets.
class PowerSpectrum {
  public:
    /// For boxes with the sides of `box`, of two dimensions or more; frequencies up to `highest`
    /// waves per unit of length.
    PowerSpectrum(const BoxParams& box, double highest);

    /// Returns how many frequencies the object would hold, 8 bytes each: a half of those in the box
    /// around the highest, as power is the same at opposite ones.
    static double count(const BoxParams& box, double highest);

    /// Adds a set: as many coordinates per sample as there are sides, at least one sample. Works on
    /// as many threads as there are cores. What `tell` throws leaves the object without the set.
    void add(std::span<const double> points, const PartDone& tell);

    std::uint32_t sets() const { return sets_; }
    std::size_t dimension() const { return sides_.size(); }
    /// The most waves along a side.
    std::int64_t most(std::size_t axis) const { return max_[axis]; }
    /// At so many waves along each side; 1 where samples know nothing of each other. Not of the
    /// mean and beyond the highest frequency, where it is 0.
    double power(std::span<const std::int64_t> waves) const;

    /// As wide as the coarsest side's frequencies are apart. The anisotropy is 1 / sets() if no
    /// direction is another than the others.
    std::vector<SpectrumRing> rings() const;

  private:
    std::size_t columns() const { return 2 * static_cast<std::size_t>(max_[0]) + 1; }
    std::size_t rows() const { return sums_.size() / columns(); }
    void set_row(std::size_t row, std::span<std::int64_t> waves) const;
    double length(std::span<const std::int64_t> waves) const;

    std::vector<double> sides_;
    double highest_;
    std::vector<std::int64_t> max_;
    std::uint32_t sets_ = 0;
    /// Sums of the sets' periodograms, row by row. A row has all waves along the first side, and
    /// certain ones along each of the others: any, but none below 0 along the last, which goes
    /// slowest.
    std::vector<double> sums_;
};

} // namespace geodisk::tools::analysis
