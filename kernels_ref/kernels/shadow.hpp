// Twin of shaders/lib/shadow.glsl: where paths that end at a vertex may go on.
//
// A shortest path keeps an angle of pi on either side of a vertex. So only what lies in the shadow
// of the vertex, as seen from where the path came, is lit through it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "constants.h"
#include "geodisk/mesh.hpp"
#include "lib/scalar.hpp"

namespace geodisk::ref {

// The arrival of a path at a vertex through a corner is one word. Above kBlurBits it has the angle
// between the corner's half-edge and the path, in units of 2^-11 radian, or kArrivedAlongPrevious;
// 0 is along the half-edge. Its error is at most 2^-10 radian, times 8 for each step of the blur;
// for kMaxBlur it is not bounded.

/// Returns the angle between (1, 0) and (x, y), y >= 0, in units of 2^-11 radian, by formula 4.4.49
/// of Abramowitz and Stegun.
template <class Real>
std::uint32_t angle_units(Real x, Real y) {
    const Real along = std::abs(x);
    const bool is_steep = y > along;
    const Real t = ratio(is_steep ? along : y, is_steep ? y : along);
    const Real t2 = t * t;
    const auto c = [](double value) { return static_cast<Real>(static_cast<float>(value)); };
    const Real series =
        c(0.999866) +
        t2 * (c(-0.3302995) + t2 * (c(0.180141) + t2 * (c(-0.085133) + t2 * c(0.0208351))));
    Real angle = t * series;
    angle = is_steep ? c(1.5707964) - angle : angle;
    angle = x < 0 ? c(3.1415927) - angle : angle;
    return static_cast<std::uint32_t>(angle * 2048);
}

/// Returns the blur of the direction of a straight path of length `way`, at the end of a path whose
/// distance has this error: the direction is off by twice the error, over the way.
template <class Real>
std::uint32_t blur_of(Real error, Real way) {
    return (error * 2048 > way ? 1u : 0u) + (error * 256 > way ? 1u : 0u) +
           (error * 32 > way ? 1u : 0u);
}

/// Returns the arrival of a path that came from the direction (x, y), in the frame of the corner's
/// half-edge.
template <class Real>
std::uint32_t arrival_from(Real x, Real y, std::uint32_t blur) {
    return angle_units(x, std::max(y, Real{0})) << gpu::kBlurBits | blur;
}

/// The directions around a vertex that paths which ended there came from, as angles of its fan, and
/// the angle all around, with which those begin again.
struct Entry {
    std::int32_t low, high, turn;
};

inline std::int32_t corner_start(std::uint32_t angles) {
    return static_cast<std::int32_t>(angles & 0xffffu);
}
inline std::int32_t corner_size(std::uint32_t angles) {
    return static_cast<std::int32_t>((angles & ~gpu::kCornerTurned) >> 16);
}

/// Lights the whole fan.
constexpr Entry kEntersFromAnywhere{-static_cast<std::int32_t>(gpu::kFarAngle),
                                    static_cast<std::int32_t>(gpu::kFarAngle),
                                    static_cast<std::int32_t>(gpu::kFarAngle)};

/// Returns the entry by a path that came in through a corner with these angles.
inline Entry entry_of(const VertexFan& fan, std::uint32_t angles, std::uint32_t arrival) {
    if ((fan.flags & gpu::kFanIrregular) != 0) {
        return kEntersFromAnywhere;
    }
    const std::uint32_t blur = arrival & gpu::kMaxBlur;
    const std::int32_t size = corner_size(angles);
    const std::int32_t error = static_cast<std::int32_t>(gpu::kAngleTolerance) << (3 * blur);
    const bool is_along_previous = arrival >= gpu::kArrivedAlongPrevious;
    const std::int32_t own =
        is_along_previous ? size : static_cast<std::int32_t>(arrival >> gpu::kBlurBits) * 4;
    std::int32_t low = std::max(own - error, 0);
    std::int32_t high = std::min(own + error + 4, size);
    if (blur == gpu::kMaxBlur || low > size) { // Beyond it by rounding.
        low = 0;
        high = size;
    }
    const bool is_turned = (angles & gpu::kCornerTurned) != 0;
    const std::int32_t start = corner_start(angles);
    return {start + (is_turned ? size - high : low), start + (is_turned ? size - low : high),
            (fan.flags & gpu::kFanOpen) != 0 ? static_cast<std::int32_t>(gpu::kFarAngle)
                                             : static_cast<std::int32_t>(fan.total_angle)};
}

/// Part of a corner that is in the shadow, as angles from its half-edge; none if low > high.
struct Shadow {
    std::int32_t low, high;
};

/// Returns the shadow in a corner with these angles: what is at least pi away from the entry on
/// both sides, or on one side of an open fan.
inline Shadow shadow_in(const Entry& entry, std::uint32_t angles) {
    const std::int32_t needed =
        static_cast<std::int32_t>(gpu::kAnglePi) - static_cast<std::int32_t>(gpu::kAngleTolerance);
    const std::int32_t start = corner_start(angles);
    const std::int32_t size = corner_size(angles);
    const std::int32_t low = entry.low + needed - start;
    const std::int32_t high = entry.high - needed - start;
    const Shadow behind{std::max(low, 0), std::min(high + entry.turn, size)};
    const Shadow before{std::max(low - entry.turn, 0), std::min(high, size)};
    const bool is_behind = behind.low <= behind.high;
    const bool is_before = before.low <= before.high;
    Shadow found = is_behind ? behind : before;
    if (is_behind && is_before) {
        found = {std::min(behind.low, before.low), std::max(behind.high, before.high)};
    }
    return (angles & gpu::kCornerTurned) != 0 ? Shadow{size - found.high, size - found.low} : found;
}

/// Returns where the ray at this angle of a corner, from its half-edge, crosses the edge opposite
/// to it, of this length; the corner is the apex of that edge.
template <class Real>
Real ray_crossing(std::int32_t angle, Real apex_x, Real apex_y, Real length) {
    const auto c = [](double value) { return static_cast<Real>(static_cast<float>(value)); };
    const Real u = static_cast<Real>(angle) * c(0x1p-13) - c(1.5707964);
    const Real u2 = u * u;
    const Real sine_u =
        u * (1 + u2 * (c(-0.16666667) +
                       u2 * (c(0.0083333333) + u2 * (c(-0.00019841270) + u2 * c(2.7557319e-6)))));
    const Real cosine_u =
        1 + u2 * (c(-0.5) +
                  u2 * (c(0.041666667) +
                        u2 * (c(-0.0013888889) + u2 * (c(2.4801587e-5) + u2 * c(-2.7557319e-7)))));
    const Real sine = std::max(cosine_u, Real{0});
    const Real cosine = -sine_u;
    const Real over = sine * (apex_x * apex_x + apex_y * apex_y);
    const Real under = (sine * apex_x + cosine * apex_y) * length;
    return length * ratio(over, under);
}

} // namespace geodisk::ref
