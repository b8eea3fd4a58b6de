// Division and square root as the decisions use them. In float both are correctly rounded, like
// shaders/lib/rounding.glsl; in double they are simply more exact.
#pragma once

#include <cmath>

namespace geodisk::ref {

/// Part of an edge below which a position counts as the edge's end; keeps quotients normal.
inline constexpr double kSmallestRatio = 0x1p-40;
/// Coordinates below it (in units of the minimum distance) count as zero.
inline constexpr double kSmallestOffset = 0x1p-40;
/// Squares below it count as zero.
inline constexpr double kSmallestSquare = 0x1p-100;
/// Stands for a distance not known.
inline constexpr double kFar = 0x1p30;

/// a / b clamped to [0, 1], for a >= 0; 1 where b is too small or negative, 0 where a vanishes
/// beside b.
template <class Real>
Real ratio(Real a, Real b) {
    if (a <= b * static_cast<Real>(kSmallestRatio) || a == 0) {
        return 0;
    }
    if (a >= b) {
        return 1;
    }
    return a / b;
}

template <class Real>
Real root(Real x) {
    return x <= static_cast<Real>(kSmallestSquare) ? Real{0} : std::sqrt(x);
}

} // namespace geodisk::ref
