// The encodings of colours in sample files. In memory, red, green and blue of samples
// are from 0 to 1 as sRGB encodes them; alpha is from 0 to 1 in every encoding.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "files/images/srgb_encoding.hpp"

namespace geodisk::tools {

enum class ColourEncoding : std::uint8_t {
    srgb,   ///< Numbers from 0 to 1, as in memory.
    bytes,  ///< The same as integers from 0 to 255.
    packed, ///< Those bytes in one number, as the Point Cloud Library has them.
    light,  ///< Amounts of light, from 0 to 1.
};

/// Component of colours that holds alpha, if there are four.
inline constexpr std::size_t kAlpha = 3;

/// Returns component `k` of a colour as light.
inline double colour_light(double value, std::size_t k) {
    return k == kAlpha ? value : light_of(value);
}

/// Replaces the light of a colour by its values in sRGB.
inline void encode_colour(std::span<double> light) {
    for (double& value : light.first(std::min(light.size(), kAlpha))) {
        value = encoded_light(value);
    }
}

/// Returns a component of a colour from 0 to 255.
inline std::uint8_t colour_byte(double value) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

/// Returns a colour of three or four components as 0xAARRGGBB, with 0 for no alpha.
inline std::uint32_t packed_colour(std::span<const double> colour) {
    std::uint32_t packed = 0;
    for (std::size_t k = 0; k < colour.size(); ++k) {
        packed |= std::uint32_t{colour_byte(colour[k])} << (k == kAlpha ? 24 : 16 - 8 * k);
    }
    return packed;
}

} // namespace geodisk::tools
