#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "files/byte_order.hpp"
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

std::uint8_t byte_at(const std::string& bytes, std::size_t at) {
    return static_cast<std::uint8_t>(bytes[at]);
}

std::uint16_t number_at(const std::string& bytes, std::size_t at) {
    return value_of_bytes<std::uint16_t>(&bytes[at]);
}

/// Returns what is wrong with a file, which stb would read all the same; "" for nothing.
std::string fault_of_tga(const std::string& bytes) {
    constexpr std::size_t kHeader = 18;
    if (bytes.size() < kHeader) {
        return "it is cut short";
    }
    const bool has_map = bytes[1] != 0;
    if (has_map && number_at(bytes, 3) != 0) {
        return "its colour map does not begin at 0";
    }
    const std::uint64_t map =
        has_map ? std::uint64_t{number_at(bytes, 5)} * ((byte_at(bytes, 7) + 7u) / 8) : 0;
    const std::uint64_t pixels = std::uint64_t{number_at(bytes, 12)} * number_at(bytes, 14);
    const std::uint64_t begin = kHeader + byte_at(bytes, 0) + map;
    const bool is_packed = byte_at(bytes, 2) >= 8;
    const std::uint64_t needed = begin + (is_packed ? 0 : pixels * ((byte_at(bytes, 16) + 7u) / 8));
    return bytes.size() < needed ? "it is cut short" : "";
}

std::string fault_of_bmp(const std::string& bytes) {
    constexpr std::size_t kHeader = 26;
    constexpr std::uint32_t kOs2Header = 12;
    const bool is_old =
        bytes.size() >= kHeader && value_of_bytes<std::uint32_t>(&bytes[14]) == kOs2Header;
    return is_old && number_at(bytes, 24) < 16 ? "its palette is that of OS/2" : "";
}

/// Returns true for a TGA file whose rows go from right to left.
bool is_mirrored(const std::string& bytes) {
    constexpr unsigned char kRightToLeft = 0x10;
    return (byte_at(bytes, 17) & kRightToLeft) != 0;
}

/// Turns rows of pixels of three bytes around.
void mirror(std::span<stbi_uc> rgb, std::size_t width) {
    for (std::size_t row = 0; row < rgb.size(); row += 3 * width) {
        for (std::size_t left = 0, right = width - 1; left < right; ++left, --right) {
            std::swap_ranges(&rgb[row + 3 * left], &rgb[row + 3 * left] + 3, &rgb[row + 3 * right]);
        }
    }
}

} // namespace

ImagePixels decode_plain(const Path& path, const std::string& bytes, PixelKind kind) {
    constexpr stbi_io_callbacks kCalls{read_some, skip, is_at_end};
    const auto fail = [&](const std::string& why) {
        fail_input(path, "cannot be read as a TGA or BMP image: " + why);
    };
    const bool is_bmp = bytes.starts_with("BM");
    if (const std::string fault = is_bmp ? fault_of_bmp(bytes) : fault_of_tga(bytes);
        !fault.empty()) {
        fail(fault);
    }
    Source source{bytes};
    int width = 0, height = 0, components = 0;
    if (stbi_info_from_callbacks(&kCalls, &source, &width, &height, &components) == 0) {
        fail("it is damaged, or of a kind that is not read");
    }
    if (width <= 0 || height == 0) {
        fail("it has no pixels");
    }
    // Rows of BMP from the top downwards have a negative height.
    const std::uint64_t count =
        static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(std::abs(height));
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
    if (!is_bmp && is_mirrored(bytes)) {
        mirror(std::span(rgb.get(), kColours * count), static_cast<std::size_t>(width));
    }
    add_pixels(std::span(rgb.get(), kColours * count), kind, pixels);
    return pixels;
}

} // namespace geodisk::tools
