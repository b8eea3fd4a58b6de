#include "files/grey_image.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

#include "files/input_file.hpp"
#include "program/failure.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
// Of the other formats, files that are cut short would pass.
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function" // Of what is not used, being static.
#include <stb_image.h>
#pragma GCC diagnostic pop

namespace geodisk::tools {
namespace {

/// The index of the pixel, for an image that repeats.
std::int64_t wrapped(double pixel, std::int64_t count) {
    const auto index = static_cast<std::int64_t>(pixel);
    return index < 0 ? index + count : index >= count ? index - count : index;
}

/// stb_image makes up what a JPEG file lacks. Behind the last scan there must be an end marker,
/// which cannot be within it.
bool is_cut_jpeg(const std::string& bytes) {
    constexpr std::string_view kStart = "\xff\xd8", kScan = "\xff\xda", kEnd = "\xff\xd9";
    const std::size_t scan = bytes.rfind(kScan);
    return bytes.starts_with(kStart) && scan != std::string::npos &&
           bytes.find(kEnd, scan) == std::string::npos;
}

} // namespace

GreyImage::GreyImage(const Path& path) {
    const std::string bytes = read_file(path);
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        fail_input(path, "is too large for an image");
    }
    if (is_cut_jpeg(bytes)) {
        fail_input(path, "is a JPEG image that is cut short");
    }
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_us, decltype(&stbi_image_free)> pixels(
        stbi_load_16_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                                 static_cast<int>(bytes.size()), &width, &height, &channels, 1),
        &stbi_image_free);
    if (!pixels) {
        fail_input(path,
                   std::string("cannot be read as a PNG or JPEG image: ") + stbi_failure_reason());
    }
    width_ = width;
    height_ = height;
    pixels_.assign(pixels.get(), pixels.get() + width_ * height_);
}

double GreyImage::at(double u, double v) const {
    // Where in units of pixels, from the centre of the upper left one.
    const double x = (u - std::floor(u)) * static_cast<double>(width_) - 0.5;
    const double y = (1 - (v - std::floor(v))) * static_cast<double>(height_) - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    const auto pixel = [&](double column, double row) {
        const std::int64_t i = wrapped(row, height_) * width_ + wrapped(column, width_);
        return static_cast<double>(pixels_[static_cast<std::size_t>(i)]) / 65535;
    };
    const auto across = [&](double row) {
        return pixel(left, row) + (x - left) * (pixel(left + 1, row) - pixel(left, row));
    };
    return across(top) + (y - top) * (across(top + 1) - across(top));
}

} // namespace geodisk::tools
