// Grey images as functions of texture coordinates.
#pragma once

#include <cstdint>
#include <vector>

#include "program/path.hpp"

namespace geodisk::tools {

class GreyImage {
  public:
    /// Reads a PNG or JPEG file. Colours become their luminance, transparency does
    /// not matter. Throws UserError(bad_input) naming the file and the cause.
    explicit GreyImage(const Path& path);

    /// From 0 (black) to 1, bilinear between the centres of pixels. v = 0 is the lower edge; the
    /// image repeats in both directions. Both must be finite.
    double at(double u, double v) const;

  private:
    std::int64_t width_ = 0, height_ = 0;
    std::vector<std::uint16_t> pixels_; ///< From the upper left, row by row.
};

} // namespace geodisk::tools
