// Images as functions of texture coordinates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "files/images/image_pixels.hpp"
#include "geometry/material_colours.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

class Image {
  public:
    std::int64_t width() const { return width_; }
    std::int64_t height() const { return height_; }

  protected:
    /// `bytes` are those of the file `name`, as messages call it.
    Image(const Path& name, const std::string& bytes, PixelKind kind);

    /// Returns a component of the colour, see GreyImage::at().
    double component(double u, double v, std::size_t index, ImageWrap wrap_u = ImageWrap::repeat,
                     ImageWrap wrap_v = ImageWrap::repeat) const;
    /// Returns the largest component of all pixels.
    double largest_component() const;

  private:
    std::int64_t width_ = 0, height_ = 0;
    std::size_t components_;            ///< Components of each pixel.
    std::vector<std::uint16_t> pixels_; ///< From the upper left, row by row.
};

class GreyImage : Image {
  public:
    using Image::height, Image::width;

    /// Reads a PNG or JPEG file. Colours become their luminance, transparency does
    /// not matter. Throws UserError(bad_input) naming the file and the cause.
    explicit GreyImage(const Path& path);

    /// From 0 (black) to 1, bilinear between the centres of pixels. v = 0 is the lower edge; the
    /// image repeats in both directions. Both must be finite.
    double at(double u, double v) const { return component(u, v, 0); }
    /// Returns the largest grey of all pixels.
    double largest() const { return largest_component(); }
};

class ColourImage : Image {
  public:
    /// The same with colours.
    explicit ColourImage(const Path& path);
    /// Decodes a file that has been read.
    explicit ColourImage(const ImageFile& file);

    /// Returns red, green and blue as GreyImage::at(), of an image that repeats, is mirrored at
    /// its edges, or continues the colours there.
    std::array<double, 3> at(double u, double v, ImageWrap wrap_u = ImageWrap::repeat,
                             ImageWrap wrap_v = ImageWrap::repeat) const {
        const auto value = [&](std::size_t i) { return component(u, v, i, wrap_u, wrap_v); };
        return {value(0), value(1), value(2)};
    }
};

} // namespace geodisk::tools
