#include "picture/power_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace geodisk::tools::picture {

Pixels power_picture(const analysis::PowerSpectrum& spectrum) {
    constexpr double kWhite = 2;
    const std::int64_t columns = spectrum.most(0), rows = spectrum.most(1);
    Pixels pixels{
        static_cast<std::uint32_t>(2 * columns + 1), static_cast<std::uint32_t>(2 * rows + 1), {}};
    pixels.rgba.reserve(std::size_t{4} * pixels.width * pixels.height);
    for (std::int64_t row = rows; row >= -rows; --row) {
        for (std::int64_t column = -columns; column <= columns; ++column) {
            const double part = std::min(1.0, spectrum.power(std::array{column, row}) / kWhite);
            const auto grey = static_cast<std::uint8_t>(std::lround(255 * part));
            pixels.rgba.insert(pixels.rgba.end(), {grey, grey, grey, 255});
        }
    }
    return pixels;
}

} // namespace geodisk::tools::picture
