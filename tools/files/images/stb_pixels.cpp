#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>

#include "files/images/image_pixels.hpp"
#include "program/failure.hpp"

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_NO_FAILURE_STRINGS
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#include <stb/stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace geodisk::tools {
namespace {

/// A file as stb reads it. Where it ends too soon, stb goes on with zeros.
struct Source {
    std::string_view left;
    bool is_short = false;
};

int read_some(void* user, char* data, int size) {
    Source& source = *static_cast<Source*>(user);
    const std::size_t count = std::min(source.left.size(), static_cast<std::size_t>(size));
    std::memcpy(data, source.left.data(), count);
    source.left.remove_prefix(count);
    source.is_short = source.is_short || count == 0;
    return static_cast<int>(count);
}

void skip(void* user, int size) {
    Source& source = *static_cast<Source*>(user);
    source.is_short =
        source.is_short || size < 0 || source.left.size() < static_cast<std::size_t>(size);
    source.left.remove_prefix(
        std::min(source.left.size(), static_cast<std::size_t>(std::max(size, 0))));
}

int is_at_end(void* user) {
    return static_cast<Source*>(user)->left.empty() ? 1 : 0;
}

} // namespace

ImagePixels decode_plain(const Path& path, const std::string& bytes, PixelKind kind) {
    constexpr stbi_io_callbacks kCalls{read_some, skip, is_at_end};
    const auto fail = [&](const char* why) {
        fail_input(path, std::string("cannot be read as a TGA or BMP image: ") + why);
    };
    Source source{bytes};
    int width = 0, height = 0, components = 0;
    if (stbi_info_from_callbacks(&kCalls, &source, &width, &height, &components) == 0) {
        fail("it is damaged, or of a kind that is not read");
    }
    const std::uint64_t count =
        static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    if (count > kMaxPixels) {
        fail("it has more than 2^26 pixels");
    }
    source = {bytes};
    constexpr int kColours = 3;
    const std::unique_ptr<stbi_uc, void (*)(void*)> rgb(
        stbi_load_from_callbacks(&kCalls, &source, &width, &height, &components, kColours),
        std::free);
    if (rgb == nullptr || source.is_short) {
        fail("it is damaged or cut short");
    }
    ImagePixels pixels{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
    add_pixels(std::span(rgb.get(), kColours * count), kind, pixels);
    return pixels;
}

} // namespace geodisk::tools
