#include "files/images/image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "files/input_file.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

constexpr double kWhite = 65535; ///< Value of a white component.

/// How files of other images begin that meshes name.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kOtherImages{
    {{"\xabKTX", "KTX"},
     {"DDS ", "DDS"},
     {"GIF8", "GIF"},
     {std::string_view("II*\0", 4), "TIFF"},
     {std::string_view("MM\0*", 4), "TIFF"},
     {"\x76\x2f\x31\x01", "OpenEXR"},
     {"#?RADIANCE", "Radiance"}}};

/// Returns the place from 0 to 1 that has the colour of another one.
double folded(double at, ImageWrap wrap) {
    switch (wrap) {
    case ImageWrap::repeat:
        break;
    case ImageWrap::mirror: {
        const double there_and_back = at - 2 * std::floor(at / 2);
        return there_and_back > 1 ? 2 - there_and_back : there_and_back;
    }
    case ImageWrap::clamp:
        return std::clamp(at, 0.0, 1.0);
    }
    return at - std::floor(at);
}

/// Returns the index of a pixel, which is no farther than one beyond the edges.
std::int64_t wrapped(double pixel, std::int64_t count, ImageWrap wrap) {
    const auto index = static_cast<std::int64_t>(pixel);
    if (wrap != ImageWrap::repeat) {
        return std::clamp(index, std::int64_t{0}, count - 1);
    }
    return index < 0 ? index + count : index >= count ? index - count : index;
}

/// TGA files begin with nothing of their own. Many end with this.
bool is_tga(const Path& path, std::string_view bytes) {
    constexpr std::string_view kFooter("TRUEVISION-XFILE.\0", 18);
    return bytes.ends_with(kFooter) || lower_case(path.extension().string()) == ".tga";
}

ImagePixels decode(const Path& path, const std::string& bytes, PixelKind kind) {
    if (bytes.starts_with("\x89PNG")) {
        return decode_png(path, bytes, kind);
    }
    if (bytes.starts_with("\xff\xd8")) {
        return decode_jpeg(path, bytes, kind);
    }
    if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) {
        return decode_webp(path, bytes, kind);
    }
    if (bytes.starts_with("BM") || is_tga(path, bytes)) {
        return decode_plain(path, bytes, kind);
    }
    for (const auto& [start, name] : kOtherImages) {
        if (std::string_view(bytes).starts_with(start)) {
            fail_input(path, "is a " + std::string(name) +
                                 " image, which is not read; convert it to PNG, JPEG or WebP");
        }
    }
    fail_input(path, "is no PNG, JPEG, WebP, TGA or BMP image");
}

} // namespace

Image::Image(const Path& name, const std::string& bytes, PixelKind kind)
    : components_(kind == PixelKind::grey ? 1 : 3) {
    ImagePixels pixels = decode(name, bytes, kind);
    width_ = pixels.width;
    height_ = pixels.height;
    pixels_ = std::move(pixels.values);
}

GreyImage::GreyImage(const Path& path) : Image(path, read_file(path), PixelKind::grey) {}

ColourImage::ColourImage(const Path& path) : Image(path, read_file(path), PixelKind::colour) {}

ColourImage::ColourImage(const ImageFile& file) : Image(file.name, file.bytes, PixelKind::colour) {}

double Image::largest_component() const {
    return static_cast<double>(*std::ranges::max_element(pixels_)) / kWhite;
}

double Image::component(double u, double v, std::size_t index, ImageWrap wrap_u,
                        ImageWrap wrap_v) const {
    // Place in units of pixels, from the centre of the upper left one.
    const double x = folded(u, wrap_u) * static_cast<double>(width_) - 0.5;
    const double y = (1 - folded(v, wrap_v)) * static_cast<double>(height_) - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    const auto pixel = [&](double column, double row) {
        const std::int64_t i =
            wrapped(row, height_, wrap_v) * width_ + wrapped(column, width_, wrap_u);
        return static_cast<double>(pixels_[static_cast<std::size_t>(i) * components_ + index]) /
               kWhite;
    };
    const auto across = [&](double row) {
        return pixel(left, row) + (x - left) * (pixel(left + 1, row) - pixel(left, row));
    };
    return across(top) + (y - top) * (across(top + 1) - across(top));
}

} // namespace geodisk::tools
