// Test of whether two ways of sampling have the same spectra.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "analysis/surface_spectrum.hpp"

namespace geodisk::paper {

/// By a permutation test: of the same sets dealt out anew to two groups of the same sizes.
struct Difference {
    double size; ///< Root of the mean square over harmonics, each by the value of its ring.
    double p;    ///< Part of the deals in which chance makes it as large.
    /// Such a size, over what chance makes, would be found, with p < 0.05, nine times of ten.
    double detectable;
};

struct SpectrumDifference {
    Difference radial_mean; ///< Difference of the natural logarithms: 0.01 is about 1 %.
    Difference anisotropy;  ///< In decibels.
};

/// Compares sets of `spectrum`, as many in one group as in the other. The anisotropy depends on how
/// many are averaged. `deals` are permutations, by `seed`.
SpectrumDifference compare_groups(const tools::analysis::SurfaceSpectrum& spectrum,
                                  std::span<const std::size_t> group,
                                  std::span<const std::size_t> other, std::uint32_t deals,
                                  std::uint64_t seed);

} // namespace geodisk::paper
