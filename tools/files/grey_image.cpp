#include "files/grey_image.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "files/input_file.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

/// The index of the pixel, for an image that repeats.
std::int64_t wrapped(double pixel, std::int64_t count) {
    const auto index = static_cast<std::int64_t>(pixel);
    return index < 0 ? index + count : index >= count ? index - count : index;
}

ImagePixels decode(const Path& path, PixelKind kind) {
    const std::string bytes = read_file(path);
    if (bytes.starts_with("\x89PNG")) {
        return decode_png(path, bytes, kind);
    }
    if (bytes.starts_with("\xff\xd8")) {
        return decode_jpeg(path, bytes, kind);
    }
    fail_input(path, "is neither a PNG nor a JPEG image");
}

} // namespace

Image::Image(const Path& path, PixelKind kind) : components_(kind == PixelKind::grey ? 1 : 3) {
    ImagePixels pixels = decode(path, kind);
    width_ = pixels.width;
    height_ = pixels.height;
    pixels_ = std::move(pixels.values);
}

double Image::component(double u, double v, std::size_t index) const {
    // Where in units of pixels, from the centre of the upper left one.
    const double x = (u - std::floor(u)) * static_cast<double>(width_) - 0.5;
    const double y = (1 - (v - std::floor(v))) * static_cast<double>(height_) - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    const auto pixel = [&](double column, double row) {
        const std::int64_t i = wrapped(row, height_) * width_ + wrapped(column, width_);
        return static_cast<double>(pixels_[static_cast<std::size_t>(i) * components_ + index]) /
               65535;
    };
    const auto across = [&](double row) {
        return pixel(left, row) + (x - left) * (pixel(left + 1, row) - pixel(left, row));
    };
    return across(top) + (y - top) * (across(top + 1) - across(top));
}

} // namespace geodisk::tools
