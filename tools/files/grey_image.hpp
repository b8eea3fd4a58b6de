// Images as functions of texture coordinates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "files/image_pixels.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

class Image {
  protected:
    Image(const Path& path, PixelKind kind);

    /// Returns a component of the colour, see GreyImage::at().
    double component(double u, double v, std::size_t index) const;

  private:
    std::int64_t width_ = 0, height_ = 0;
    std::size_t components_;            ///< Of each pixel.
    std::vector<std::uint16_t> pixels_; ///< From the upper left, row by row.
};

class GreyImage : Image {
  public:
    /// Reads a PNG or JPEG file. Colours become their luminance, transparency does
    /// not matter. Throws UserError(bad_input) naming the file and the cause.
    explicit GreyImage(const Path& path) : Image(path, PixelKind::grey) {}

    /// From 0 (black) to 1, bilinear between the centres of pixels. v = 0 is the lower edge; the
    /// image repeats in both directions. Both must be finite.
    double at(double u, double v) const { return component(u, v, 0); }
};

class ColourImage : Image {
  public:
    /// The same with colours.
    explicit ColourImage(const Path& path) : Image(path, PixelKind::colour) {}

    /// Returns red, green and blue as GreyImage::at().
    std::array<double, 3> at(double u, double v) const {
        return {component(u, v, 0), component(u, v, 1), component(u, v, 2)};
    }
};

} // namespace geodisk::tools
