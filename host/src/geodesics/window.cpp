#include "geodesics/window.hpp"

namespace geodisk::geodesics {
namespace {

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

/// Cuts [low, high] off a window where it is one of its ends.
void cut(Window& window, double low, double high) {
    if (high >= window.end) {
        window.end = std::min(window.end, low);
    } else if (low <= window.begin) {
        window.begin = high;
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
            cut(second, low, high);
        }
    } else if (at_low >= -tie && at_high >= -tie) {
        if (between() >= -tie) {
            cut(first, low, high);
        }
    } else {
        const double equal = equal_point(first, second, low, high);
        Window& farther_at_low = at_low < 0 ? second : first;
        Window& farther_at_high = at_low < 0 ? first : second;
        cut(farther_at_low, low, equal);
        cut(farther_at_high, equal, high);
    }
}

} // namespace geodisk::geodesics
