// Tests of whether samples of many seeds lie on a surface as its area does.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace geodisk::tools::analysis {

/// Parts of a surface that hang together in space, of about equal area: the faces are halved by
/// area, again and again, along the longest side of their bounding box.
struct Regions {
    std::vector<std::uint32_t> of_face;
    std::vector<double> areas;
};

/// `centers` holds `dimension` coordinates for each face; `count` is a power of two. A face is in
/// one region whole, so that large faces make fewer or unequal ones.
Regions make_regions(std::span<const double> centers, std::uint32_t dimension,
                     std::span<const double> areas, std::uint32_t count);

/// A test of whether each region holds a part of the samples as large as its part of the area.
struct Evenness {
    std::uint32_t sets = 0, regions = 0;
    double dispersion = 0; ///< Variance of counts over their mean: 1 if samples were independent.
    double chi_square = 0; ///< Sum over regions of squared mean deviations, over their variance.
    std::uint32_t freedom = 0;
    double p = 1; ///< Probability of so large a sum, or larger, if all is even.
};

/// `counts` holds those of each region, set by set. The variance is that of the counts from set to
/// set, as samples that keep a distance vary less than independent ones. Nothing of fewer than 2
/// sets or regions with area.
std::optional<Evenness> test_evenness(std::span<const std::vector<double>> counts,
                                      std::span<const double> areas);

/// The probability that chi^2 of so many degrees of freedom is at least this large, by the
/// approximation of Wilson and Hilferty (1931).
double chi_square_tail(double chi_square, double freedom);

} // namespace geodisk::tools::analysis
