// Twin of shaders/kernels/place.comp: position of a sample in space.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace geodisk::ref {

using Vec = std::array<double, 3>;

/// Interpolates linearly in a triangle, at the point with these weights of its second and third
/// corner.
inline Vec weighed(const std::array<Vec, 3>& corners, double weight1, double weight2) {
    Vec sum{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        sum[axis] = (1 - weight1 - weight2) * corners[0][axis] + weight1 * corners[1][axis] +
                    weight2 * corners[2][axis];
    }
    return sum;
}

/// Returns the vector with length 1; a zero vector stays.
inline Vec normalized(Vec v) {
    const double length = std::hypot(v[0], v[1], v[2]);
    for (double& coordinate : v) {
        coordinate = length > 0 ? coordinate / length : 0;
    }
    return v;
}

/// Returns the normal of a triangle, on the side from which its corners run counterclockwise.
inline Vec face_normal(const std::array<Vec, 3>& corners) {
    Vec u{}, v{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        u[axis] = corners[1][axis] - corners[0][axis];
        v[axis] = corners[2][axis] - corners[0][axis];
    }
    u = normalized(u);
    v = normalized(v);
    return normalized(
        {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]});
}

} // namespace geodisk::ref
