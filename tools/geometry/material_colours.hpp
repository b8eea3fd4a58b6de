// Colours of the materials of a mesh file.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace geodisk::tools {

/// Colours beyond the edges of an image.
enum class ImageWrap : std::uint8_t { repeat, mirror, clamp };

struct MaterialColour {
    /// Red, green and blue, by which an image is multiplied.
    std::array<double, 3> factor{1, 1, 1};
    bool is_linear = false; ///< True for a factor of light; else of values as sRGB encodes them.
    std::optional<std::uint32_t> image; ///< Index in MaterialColours::images.
    /// Two rows (a, b, c): a u + b v + c is where in the image texture coordinates are.
    std::array<double, 6> transform{1, 0, 0, 0, 1, 0};
    ImageWrap wrap_u = ImageWrap::repeat, wrap_v = ImageWrap::repeat;

    /// Returns where in the image texture coordinates are.
    std::array<double, 2> place(double u, double v) const {
        const auto& t = transform;
        return {t[0] * u + t[1] * v + t[2], t[3] * u + t[4] * v + t[5]};
    }
};

/// An image as read, not decoded.
struct ImageFile {
    std::string name; ///< For messages.
    std::string bytes;
};

struct MaterialColours {
    /// Those that faces use, by the number of the material.
    std::vector<std::optional<MaterialColour>> colours;
    std::vector<ImageFile> images;
};

} // namespace geodisk::tools
