// Numbers that sum up measurements.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace geodisk::bench {

/// The middle value, or the mean of the two in the middle. `values` must not be empty.
double median(std::vector<double> values);

struct Point {
    double x, y;
};

/// y is about factor * x^exponent.
struct PowerLaw {
    double exponent = 0;
    double factor = 0;
    double r_squared = 0; ///< Share of the variance of log y that the law explains.
    std::size_t points = 0;
    double from = 0; ///< The least x.
};

/// Least squares in logarithms over the points with positive coordinates; nothing if these have
/// fewer than two different x.
std::optional<PowerLaw> fit_power_law(std::span<const Point> points);

/// The same over the points from that of least y on, but at least the last two. Times fall with the
/// number of samples first, since disks shrink, and then rise. `points` must ascend in x.
std::optional<PowerLaw> fit_rise(std::span<const Point> points);

} // namespace geodisk::bench
