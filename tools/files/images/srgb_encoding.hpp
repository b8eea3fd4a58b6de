// The encoding of sRGB: between encoded values and amounts of light, both from 0 to 1.
#pragma once

#include <cmath>

namespace geodisk::tools {

/// Returns the amount of light of an encoded value.
inline double light_of(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Returns the encoded value of an amount of light; exactly 1 for 1.
inline double encoded_light(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1 + 1.055 * (std::pow(light, 1 / 2.4) - 1);
}

} // namespace geodisk::tools
