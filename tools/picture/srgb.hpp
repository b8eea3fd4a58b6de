// Between the codes of sRGB and amounts of light from 0 to 1.
#pragma once

#include <array>
#include <cstdint>

namespace geodisk::tools::picture {

/// Returns the amount of light of each code.
const std::array<float, 256>& light_of_srgb();

/// Returns the code of an amount of light.
std::uint8_t to_srgb(float light);

} // namespace geodisk::tools::picture
