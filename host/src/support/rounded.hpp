// Division and square root as decisions use them: shaders/lib/rounding.glsl in float on the host.
#pragma once

#include <cmath>

namespace geodisk {

/// Returns a / b clamped to [0, 1], for a >= 0; 1 if b is too small or negative, 0 if a is
/// negligible.
inline float ratio(float a, float b) {
    if (a <= b * 0x1p-40f || a == 0) {
        return 0;
    }
    return a >= b ? 1 : a / b;
}

/// Returns the square root of x; 0 if x is negligible.
inline float root(float x) {
    return x <= 0x1p-100f ? 0 : std::sqrt(x);
}

} // namespace geodisk
