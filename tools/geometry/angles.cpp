#include "geometry/angles.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

// Only +, -, *, / and the square root, which IEEE 754 rounds in one way.
namespace geodisk::tools {
namespace {

/// sin(x), or from 1 on cos(x), by their series; |x| is at most pi/4.
double series(double x, double first, int power) {
    double sum = first, term = first;
    for (; power < 20; power += 2) {
        term *= -x * x / ((power + 1) * (power + 2));
        sum += term;
    }
    return sum;
}

/// The sine `quarters` of a turn ahead.
double sine_ahead(double angle, std::uint64_t quarters) {
    // Half a pi in two parts, of which the first times a small integer is exact.
    constexpr double kHigh = 0x1.921fb544p0;
    constexpr double kLow = 0x1.0b4611a626331p-34;
    const double turns = std::floor(angle / (std::numbers::pi / 2) + 0.5);
    const double rest = (angle - turns * kHigh) - turns * kLow;
    const auto quadrant = static_cast<std::uint64_t>(static_cast<std::int64_t>(turns)) + quarters;
    const double value = quadrant % 2 == 0 ? series(rest, rest, 1) : series(rest, 1, 0);
    return quadrant % 4 < 2 ? value : -value;
}

} // namespace

double sine(double angle) {
    return sine_ahead(angle, 0);
}

double cosine(double angle) {
    return sine_ahead(angle, 1);
}

double angle_of(double y, double x) {
    if (x < 0) {
        return std::numbers::pi - angle_of(y, -x);
    }
    if (y == 0) {
        return 0; // Of no vector, too.
    }
    // Half the angle again and again, until the series of its tangent is short.
    constexpr int kHalvings = 3;
    double doubled = 1;
    for (int i = 0; i < kHalvings; ++i) {
        x += std::sqrt(x * x + y * y); // Between the vector and the axis.
        doubled *= 2;
    }
    const double tangent = y / x;
    double sum = 0, power = tangent;
    for (int n = 1; n < 24; n += 2) {
        sum += power / n;
        power *= -tangent * tangent;
    }
    return doubled * sum;
}

} // namespace geodisk::tools
