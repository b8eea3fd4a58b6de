#include "geometry/triangle_angles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/angles.hpp"

namespace geodisk::tools {
namespace {

constexpr double kMinGood = 30, kLargestGood = 120;

/// Returns the angle between the sides a and b of a triangle, in degrees.
double angle_between(double a, double b, double opposite) {
    const double dot = (a * a + b * b - opposite * opposite) / 2;
    const double square = a * a * b * b - dot * dot;
    return angle_of(std::sqrt(std::max(0.0, square)), dot) * 180 / std::numbers::pi;
}

} // namespace

TriangleAngles triangle_angles(std::span<const double> points, std::uint32_t dimension,
                               std::span<const std::array<std::uint32_t, 3>> triangles) {
    TriangleAngles angles;
    if (triangles.empty()) {
        return angles;
    }
    angles.least = 180;
    std::size_t good = 0;
    const auto length = [&](std::uint32_t a, std::uint32_t b) {
        double square = 0;
        for (std::uint32_t axis = 0; axis < dimension; ++axis) {
            const double difference = points[std::size_t{a} * dimension + axis] -
                                      points[std::size_t{b} * dimension + axis];
            square += difference * difference;
        }
        return std::sqrt(square);
    };
    for (const auto& [a, b, c] : triangles) {
        const double ab = length(a, b), bc = length(b, c), ca = length(c, a);
        const auto [low, high] = std::minmax(
            {angle_between(ab, ca, bc), angle_between(ab, bc, ca), angle_between(bc, ca, ab)});
        angles.least = std::min(angles.least, low);
        angles.largest = std::max(angles.largest, high);
        good += low >= kMinGood && high <= kLargestGood ? 1 : 0;
    }
    angles.part_inside = static_cast<double>(good) / static_cast<double>(triangles.size());
    return angles;
}

} // namespace geodisk::tools
