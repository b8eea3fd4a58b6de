#include "common/polygon_flattening.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace geodisk::tools {

namespace {

using Vector = std::vector<double>;

double dot(const Vector& a, const Vector& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Corners relative to the first, in units of the largest coordinate.
std::vector<Vector> relative_corners(std::span<const double> positions, std::uint32_t dimension,
                                     std::span<const std::uint32_t> corners) {
    const auto coordinates = [&](std::uint32_t vertex) {
        return positions.subspan(std::size_t{vertex} * dimension, dimension);
    };
    double largest = 0;
    for (const std::uint32_t vertex : corners) {
        for (const double x : coordinates(vertex)) {
            largest = std::max(largest, std::abs(x));
        }
    }
    const double unit = largest > 0 ? largest : 1;
    std::vector<Vector> points;
    for (const std::uint32_t vertex : corners) {
        Vector& point = points.emplace_back(dimension);
        for (std::size_t axis = 0; axis < dimension; ++axis) {
            point[axis] = coordinates(vertex)[axis] / unit - coordinates(corners[0])[axis] / unit;
        }
    }
    return points;
}

/// The unit vector along the longest of `points`, whose part along it is then taken off all of
/// them and returned; zeros when all are zero.
Vector take_axis(std::vector<Vector>& points) {
    const auto longest =
        std::max_element(points.begin(), points.end(),
                         [](const Vector& a, const Vector& b) { return dot(a, a) < dot(b, b); });
    const double size = std::sqrt(dot(*longest, *longest));
    Vector along(points.size(), 0.0);
    if (size == 0) {
        return along;
    }
    Vector axis = *longest;
    for (double& x : axis) {
        x /= size;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        along[i] = dot(points[i], axis);
        for (std::size_t k = 0; k < axis.size(); ++k) {
            points[i][k] -= along[i] * axis[k];
        }
    }
    return along;
}

} // namespace

std::vector<double> flattened_polygon(std::span<const double> positions, std::uint32_t dimension,
                                      std::span<const std::uint32_t> corners) {
    std::vector<Vector> points = relative_corners(positions, dimension, corners);
    const Vector x = take_axis(points);
    const Vector y = take_axis(points);
    std::vector<double> flat;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        flat.insert(flat.end(), {x[i], y[i], 0});
    }
    return flat;
}

} // namespace geodisk::tools
