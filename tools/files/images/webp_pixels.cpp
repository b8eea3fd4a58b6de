#include <memory>

#include <webp/decode.h>

#include "files/images/image_pixels.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {

ImagePixels decode_webp(const Path& path, const std::string& bytes, PixelKind kind) {
    const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    WebPBitstreamFeatures features{};
    if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK) {
        fail_input(path, "cannot be read as a WebP image");
    }
    if (features.has_animation != 0) {
        fail_input(path, "is a WebP animation, not an image");
    }
    int width = 0, height = 0;
    const std::unique_ptr<std::uint8_t, void (*)(void*)> rgb(
        WebPDecodeRGB(data, bytes.size(), &width, &height), WebPFree);
    if (rgb == nullptr) { // At most 2^14 pixels each way.
        fail_input(path, "cannot be read as a WebP image: it is damaged or cut short");
    }
    ImagePixels pixels{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
    const std::size_t count = std::size_t{pixels.width} * pixels.height;
    if (count > kMaxPixels) {
        fail_input(path, "cannot be read as a WebP image: it has more than 2^26 pixels");
    }
    add_pixels(std::span(rgb.get(), 3 * count), kind, pixels);
    return pixels;
}

} // namespace geodisk::tools
