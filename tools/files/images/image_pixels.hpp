// Decodes image files to pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "program/path.hpp"

namespace geodisk::tools {

/// Most pixels of an image: more than any texture has, and few enough for a file of some kilobytes
/// not to take all memory.
inline constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 26;

enum class PixelKind : std::uint8_t { grey, colour };

struct ImagePixels {
    std::uint32_t width = 0, height = 0;
    /// 0 to 65535, from the upper left, row by row; red, green and blue of coloured pixels.
    std::vector<std::uint16_t> values;
};

/// The luminance of a colour, of as many bits as its parts.
inline std::uint16_t luminance(std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
    return static_cast<std::uint16_t>((77 * red + 150 * green + 29 * blue) >> 8);
}
/// Returns the same of numbers from 0 to 1.
inline double grey_of(double red, double green, double blue) {
    return (77 * red + 150 * green + 29 * blue) / 256;
}

/// Appends pixels of three bytes each.
inline void add_pixels(std::span<const std::uint8_t> rgb, PixelKind kind, ImagePixels& pixels) {
    for (std::size_t i = 0; i + 3 <= rgb.size(); i += 3) {
        const std::uint32_t red = 257u * rgb[i], green = 257u * rgb[i + 1],
                            blue = 257u * rgb[i + 2];
        if (kind == PixelKind::grey) {
            pixels.values.push_back(luminance(red, green, blue));
        } else {
            for (const std::uint32_t value : {red, green, blue}) {
                pixels.values.push_back(static_cast<std::uint16_t>(value));
            }
        }
    }
}

/// `bytes` are those of the file `path`, which errors name. Transparency is ignored. Throw
/// UserError(bad_input) for what is damaged, cut short or has too many pixels.
ImagePixels decode_png(const Path& path, const std::string& bytes, PixelKind kind);
ImagePixels decode_jpeg(const Path& path, const std::string& bytes, PixelKind kind);
ImagePixels decode_webp(const Path& path, const std::string& bytes, PixelKind kind);
/// TGA and BMP.
ImagePixels decode_plain(const Path& path, const std::string& bytes, PixelKind kind);

} // namespace geodisk::tools
