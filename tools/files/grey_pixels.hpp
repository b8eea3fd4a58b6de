// Decodes image files to grey pixels.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "program/path.hpp"

namespace geodisk::tools {

/// Most pixels of an image: more than any texture has, and few enough for a file of some kilobytes
/// not to take all memory.
inline constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 26;

struct GreyPixels {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint16_t> values; ///< 0 to 65535, from the upper left, row by row.
};

/// The luminance of a colour, of as many bits as its parts.
inline std::uint16_t luminance(std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
    return static_cast<std::uint16_t>((77 * red + 150 * green + 29 * blue) >> 8);
}

/// `bytes` are those of the file `path`, which errors name. Transparency is ignored. Throw
/// UserError(bad_input) for what is damaged, cut short or has too many pixels.
GreyPixels decode_png(const Path& path, const std::string& bytes);
GreyPixels decode_jpeg(const Path& path, const std::string& bytes);

} // namespace geodisk::tools
