// Power spectra of samples in the plane.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/box.hpp>

#include "analysis/spectrum_rings.hpp"
#include "program/batches.hpp"

namespace geodisk::tools::analysis {

/// The periodogram |sum over samples of exp(-2 pi i f x)|^2 / N at all frequencies that a periodic
/// rectangle has, whole numbers of waves along each side, without the mean; the average over sets.
class PowerSpectrum {
  public:
    /// For boxes with the sides of `box`, which has two dimensions; frequencies up to `highest`
    /// waves per unit of length.
    PowerSpectrum(const BoxParams& box, double highest);

    /// How many frequencies there are; half of what is mirrored at 0.
    std::size_t size() const;

    /// Adds a set: two coordinates per sample, at least one sample. Works on as many threads as
    /// there are cores. What `tell` throws leaves the object without the set.
    void add(std::span<const double> points, const PartDone& tell);

    std::uint32_t sets() const { return sets_; }
    /// Waves along each side: columns -columns() to columns(), rows 0 to rows().
    std::uint32_t columns() const { return columns_; }
    std::uint32_t rows() const { return rows_; }
    /// 1 where samples know nothing of each other. Not of (0, 0) and beyond the highest frequency,
    /// where it is 0.
    double power(std::int64_t column, std::int64_t row) const;

    /// As wide as the coarser side's frequencies are apart. The anisotropy is 1 / sets() if no
    /// direction is another than the others.
    std::vector<SpectrumRing> rings() const;

  private:
    std::size_t index(std::int64_t column, std::uint32_t row) const;

    double width_, height_, highest_;
    std::uint32_t columns_, rows_;
    std::uint32_t sets_ = 0;
    std::vector<double> sums_; ///< Of the sets' periodograms, row by row.
};

} // namespace geodisk::tools::analysis
