#include "geodesics/window.hpp"

namespace geodisk::geodesics {
namespace {

/// Part of the length of an edge below which a root is close to it.
constexpr double kClose = 1e-3;

/// Angle between rays, in radians, that counts.
constexpr double kAngle = 1e-9;

/// Returns how much shorter the paths of `second` are at a point.
double gain(const Window& first, const Window& second, double at) {
    return first.distance_to(at) - second.distance_to(at);
}

/// Returns where within [low, high] the gain is least or largest. Along the edge it has one such
/// place: in line with both roots.
double turning_point(const Window& first, const Window& second, double low, double high) {
    const double rise = first.y - second.y;
    return rise == 0 ? low
                     : std::clamp((second.x * first.y - first.x * second.y) / rise, low, high);
}

/// Returns the point where both are equally far, which lies in [low, high] if the gain changes its
/// sign there: |p - a| - |p - b| = difference of sigma, squared twice.
double equal_point(const Window& a, const Window& b, double low, double high) {
    const double difference = b.sigma - a.sigma;
    const double slope = 2 * (b.x - a.x);
    const double rest = square(a.x) + square(a.y) - square(b.x) - square(b.y) - square(difference);
    const auto is_within = [&](double p) { return p >= low && p <= high; };
    if (difference == 0) {
        if (const double p = -rest / slope; is_within(p)) {
            return p;
        }
    } else {
        const double two = square(slope) - 4 * square(difference);
        const double one = 2 * slope * rest + 8 * square(difference) * b.x;
        const double none = square(rest) - 4 * square(difference) * (square(b.x) + square(b.y));
        const double under = one * one - 4 * two * none;
        const double q = -0.5 * (one + std::copysign(std::sqrt(std::max(under, 0.0)), one));
        for (const double p : {q / two, none / q}) {
            if (is_within(p) && (slope * p + rest) * difference >= 0) {
                return p;
            }
        }
    }
    // The formula has lost its digits: halve.
    const bool rises = gain(a, b, high) > gain(a, b, low);
    for (int i = 0; i < 60; ++i) {
        const double middle = low + (high - low) / 2;
        ((gain(a, b, middle) > 0) == rises ? high : low) = middle;
    }
    return high;
}

/// Returns true if two windows are views of one root.
bool are_of_one_root(const Window& a, const Window& b, double tie) {
    return std::abs(a.sigma - b.sigma) <= tie && std::abs(a.x - b.x) <= tie &&
           std::abs(a.y - b.y) <= tie;
}

/// Returns where, from `end` towards `other` on, a window is farther than another one by more than
/// rounding. Where that moves its rays by less than an angle that counts, returns `end`. A root
/// close to the edge sends rays of all directions through a part as small as rounding.
double end_of_loss(const Window& loser, const Window& winner, double end, double other,
                   double tie) {
    const double square_way = loser.square_to(end);
    if (square_way > square(kClose * (other - end)) || !(square_way > 0)) {
        return end;
    }
    const double loss = gain(loser, winner, end);
    const double way = std::sqrt(square_way);
    if (loss > tie || are_of_one_root(loser, winner, tie)) {
        return end;
    }
    const double slope =
        (end - loser.x) / way - (end - winner.x) / std::sqrt(winner.square_to(end));
    const double rise = other > end ? slope : -slope;
    const double step = rise > 0 ? (tie - loss) / rise : std::abs(other - end);
    if (step * loser.y <= kAngle * square(way)) {
        return end;
    }
    return other > end ? std::min(end + step, other) : std::max(end - step, other);
}

/// Cuts off a window what another one reaches sooner, [low, high], where that is one of its ends.
void cut(Window& window, const Window& winner, double low, double high, double tie) {
    const double begin = end_of_loss(window, winner, low, high, tie);
    const double end = end_of_loss(window, winner, high, low, tie);
    if (!(begin < end)) {
        return;
    }
    if (end >= window.end) {
        window.end = std::min(window.end, begin);
    } else if (begin <= window.begin) {
        window.begin = end;
    }
}

} // namespace

void trim(Window& first, Window& second) {
    const double low = std::max(first.begin, second.begin);
    const double high = std::min(first.end, second.end);
    if (!(low < high)) {
        return;
    }
    const double tie = kTie * first.distance_to(low);
    const double at_low = gain(first, second, low), at_high = gain(first, second, high);
    const auto between = [&] {
        return gain(first, second, turning_point(first, second, low, high));
    };
    if (at_low <= tie && at_high <= tie) {
        if (between() <= tie) {
            cut(second, first, low, high, tie);
        }
    } else if (at_low >= -tie && at_high >= -tie) {
        if (between() >= -tie) {
            cut(first, second, low, high, tie);
        }
    } else {
        const double equal = equal_point(first, second, low, high);
        const Window one = first, other = second;
        if (at_low < 0) {
            cut(second, one, low, equal, tie);
            cut(first, other, equal, high, tie);
        } else {
            cut(first, other, low, equal, tie);
            cut(second, one, equal, high, tie);
        }
    }
}

} // namespace geodisk::geodesics
