// Pictures of a surface and the samples on it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "picture/gpu.hpp"
#include "picture/renderer.hpp"
#include "picture/view.hpp"
#include "picture/window_table.hpp"

namespace geodisk::tools::picture {

/// Style in which samples are shown, all by exact geodesic distance.
enum class Style {
    automatic, ///< Disks, or points where disks would be too small to tell apart.
    disks,     ///< The disk of each sample's radius; where two overlap, in another colour.
    points,    ///< The samples.
    voronoi,   ///< To which sample each place is nearest, in radii of the sample.
    distance,  ///< Distance to that sample, with lines at each half radius.
    density,   ///< Samples per length, the root of those per area, by the kernel
               ///< 1 - (distance / 5 radii)^2.
};

/// Name of a style as the command line has it: "auto", "disks" and so on.
const char* to_string(Style style);

/// The style of this name. Throws UserError(usage) naming `option`.
Style parse_style(const std::string& option, const std::string& text);

/// Returns how far around a sample a style looks, in radii of the sample.
double reach_of(Style style);

struct Pixels {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba; ///< Row by row from the top, sRGB, alpha not multiplied in.
};

/// Grey in 16 bits.
struct DeepPixels {
    struct Texel {
        std::uint16_t grey = 0;
        bool is_opaque = false;

        std::uint16_t alpha() const { return is_opaque ? 65535 : 0; }
    };

    std::uint32_t width = 0, height = 0;
    std::vector<Texel> texels; ///< Row by row from the top.
};

/// A colour behind the surface, sRGB.
struct Background {
    std::uint8_t red = 255, green = 255, blue = 255, alpha = 255;
};

/// "white", "black", "transparent" or "RRGGBB". Throws UserError(usage) naming `option`.
Background parse_background(const std::string& option, const std::string& text);

struct PictureParams {
    static constexpr std::uint32_t kMaxPixels = 16384; ///< Along each side.
    static constexpr std::uint32_t kFewestPixels = 16;

    std::uint32_t width = 1920, height = 1080;
    Style style = Style::automatic;
    std::vector<std::optional<View>> views{std::nullopt}; ///< None is a good one, see choose_view.
    std::optional<Up> up;                                 ///< Else likely_up().
    Background background;
    bool cuts = false;   ///< Cuts away the eighth of a box nearest to the eye.
    bool legend = false; ///< Below each view, see Legend.
};

/// A picture and what it shows.
struct Picture {
    Pixels pixels;
    std::vector<View> views;    ///< As shown.
    Style style = Style::disks; ///< As drawn, of the first view.
    Up up = Up::y;
};

/// Draws all views side by side; of a content with balls, these and the frame around them.
/// `tell` may throw. Throws UserError.
Picture draw_picture(const Gpu& gpu, const Content& content, const PictureParams& params,
                     const PartDone& tell);

} // namespace geodisk::tools::picture
