// Colours of the materials of a mesh file.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace geodisk::tools {

/// Number of the tile of texture coordinates from 0 to 1. The next nine lie at larger u, and ten
/// more at larger v.
inline constexpr std::uint32_t kFirstTile = 1001, kTilesPerRow = 10;

/// Colours beyond the edges of an image.
enum class ImageWrap : std::uint8_t { repeat, mirror, clamp };

struct MaterialColour {
    /// Red, green and blue, by which an image is multiplied.
    std::array<double, 3> factor{1, 1, 1};
    bool is_linear = false; ///< True for a factor of light; else of values as sRGB encodes them.
    std::optional<std::uint32_t> image; ///< Index in MaterialColours::images.
    /// The same for the images of a set (UDIM), by the number of their tile; else empty.
    std::map<std::uint32_t, std::uint32_t> tiles;
    bool has_tiles_by_name = false; ///< Else places without a tile have `image`, which repeats.
    /// Two rows (a, b, c): a u + b v + c is where in the image texture coordinates are.
    std::array<double, 6> transform{1, 0, 0, 0, 1, 0};
    ImageWrap wrap_u = ImageWrap::repeat, wrap_v = ImageWrap::repeat;

    /// Returns the number of the tile at a place, or nothing beyond all tiles.
    static std::optional<std::uint32_t> tile_at(const std::array<double, 2>& place) {
        constexpr double kRows = 900;
        const double u = std::floor(place[0]), v = std::floor(place[1]);
        if (!(u >= 0 && u < kTilesPerRow && v >= 0 && v < kRows)) {
            return std::nullopt;
        }
        return kFirstTile + static_cast<std::uint32_t>(u + kTilesPerRow * v);
    }
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
