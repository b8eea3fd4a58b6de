#include "picture/srgb.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "files/images/srgb_encoding.hpp"

namespace geodisk::tools::picture {

const std::array<float, 256>& light_of_srgb() {
    static const std::array<float, 256> kTable = [] {
        std::array<float, 256> light{};
        for (std::size_t i = 0; i < light.size(); ++i) {
            light[i] = static_cast<float>(light_of(static_cast<double>(i) / 255));
        }
        return light;
    }();
    return kTable;
}

std::uint8_t to_srgb(float light) {
    // Finer than the codes.
    constexpr std::size_t kSteps = std::size_t{1} << 16;
    static const std::vector<std::uint8_t> kTable = [] {
        std::vector<std::uint8_t> codes;
        codes.reserve(kSteps);
        for (std::size_t i = 0; i < kSteps; ++i) {
            const double encoded = encoded_light(static_cast<double>(i) / (kSteps - 1));
            codes.push_back(static_cast<std::uint8_t>(std::lround(encoded * 255)));
        }
        return codes;
    }();
    return kTable[static_cast<std::size_t>(
        std::lround(std::clamp(light, 0.0f, 1.0f) * (kSteps - 1)))];
}

} // namespace geodisk::tools::picture
