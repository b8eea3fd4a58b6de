// Twin of shaders/lib/curve.glsl: the closed form of Bowers et al. 2010.
#pragma once

#include <array>
#include <cmath>

#include "lib/scalar.hpp"

namespace geodisk::ref {

template <class Real>
Real signed_ratio(Real a, Real b) {
    const Real magnitude = ratio(std::abs(a), b);
    return a < 0 ? -magnitude : magnitude;
}

template <class Real>
Real product3(const std::array<Real, 3>& a, const std::array<Real, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Returns the arc sine to 2^-23.
template <class Real>
Real arcsine(Real x) {
    const auto real = [](float value) { return static_cast<Real>(value); };
    const Real magnitude = std::abs(x);
    const bool is_wide = magnitude > real(0.5f);
    const Real rest = real(0.5f) * (1 - magnitude);
    const Real s = is_wide ? root(rest) : magnitude;
    const Real z = is_wide ? rest : magnitude * magnitude;
    const Real series =
        (((real(4.2163199e-2f) * z + real(2.4181311e-2f)) * z + real(4.5470026e-2f)) * z +
         real(7.4953003e-2f)) *
            z +
        real(1.6666752e-1f);
    const Real angle = series * z * s + s;
    const Real result = is_wide ? real(1.5707964f) - 2 * angle : angle;
    return x < 0 ? -result : result;
}

/// Returns true if the curve between two points whose normals turn evenly is shorter than a limit,
/// given as a square; `square` is that of the straight line.
template <class Real>
bool is_short_curve(const std::array<Real, 3>& way, Real square, const std::array<Real, 3>& normal,
                    const std::array<Real, 3>& other_normal, Real limit2) {
    constexpr auto kSameAngle = static_cast<Real>(0x1p-6);
    const Real straight = root(square);
    const Real from = signed_ratio(product3(normal, way), straight);
    const Real to = signed_ratio(product3(other_normal, way), straight);
    const Real apart = from - to;
    const Real middle = static_cast<Real>(0.5) * (from + to);
    if (std::abs(apart) < kSameAngle) {
        return square < limit2 * (1 - middle * middle);
    }
    return straight * std::abs(arcsine(from) - arcsine(to)) < root(limit2) * std::abs(apart);
}

} // namespace geodisk::ref
