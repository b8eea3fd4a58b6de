// Checks that counts are as expected.
#pragma once

#include <cmath>
#include <vector>

#include <doctest/doctest.h>

namespace geodisk::test {

/// Returns true if a chi-square sum over `freedom` degrees is within 5 standard deviations of its
/// mean. Of right counts one sum in 5,000 is not over 15 degrees, one in 300,000 over 1,000. Seeds
/// are fixed, so a test that passes does so always.
inline bool is_plausible(double chi_square, double freedom) {
    return std::abs(chi_square - freedom) < 5 * std::sqrt(2 * freedom);
}

inline double chi_square(const std::vector<double>& counts, const std::vector<double>& expected) {
    double sum = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        sum += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
    }
    return sum;
}

inline void check_chi_square(const std::vector<double>& counts, const std::vector<double>& expected,
                             double freedom) {
    const double sum = chi_square(counts, expected);
    CHECK_MESSAGE(is_plausible(sum, freedom), "chi-square ", sum, " of ", freedom);
}

} // namespace geodisk::test
