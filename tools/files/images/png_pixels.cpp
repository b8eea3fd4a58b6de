#include <csetjmp>
#include <cstring>
#include <utility>

#include <png.h>

#include "files/images/image_pixels.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

/// State that libpng's callbacks share. libpng ends on errors by a jump, over which nothing may
/// live that has a destructor.
struct PngReader {
    const unsigned char* next = nullptr;
    std::size_t left = 0;
    std::jmp_buf on_error;
    char error[200] = {};

    static PngReader& of(png_structp png) {
        return *static_cast<PngReader*>(png_get_error_ptr(png));
    }

    [[noreturn]] static void fail(png_structp png, const char* message) {
        PngReader& reader = of(png);
        std::strncpy(reader.error, message, sizeof reader.error - 1);
        std::longjmp(reader.on_error, 1);
    }

    static void warn(png_structp, const char*) {}

    static void read(png_structp png, png_bytep to, std::size_t count) {
        PngReader& reader = of(png);
        if (count > reader.left) {
            fail(png, "the file is cut short");
        }
        std::memcpy(to, reader.next, count);
        reader.next += count;
        reader.left -= count;
    }
};

/// Asks for rows of red, green and blue with 16 bits in the order of this machine.
void ask_for_rgb16(png_structp png, png_infop info) {
    png_set_expand(png);
    png_set_expand_16(png);
    png_set_strip_alpha(png);
    png_set_gray_to_rgb(png);
    const std::uint16_t one = 1;
    unsigned char first = 0;
    std::memcpy(&first, &one, 1);
    if (first == 1) {
        png_set_swap(png);
    }
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
}

/// False on an error, which `reader` has the text of. Fills `rows`, then `pixels`.
bool decode(PngReader& reader, png_structp png, png_infop info, ImagePixels& pixels,
            std::vector<std::uint16_t>& rgb, std::vector<png_bytep>& rows) {
    if (setjmp(reader.on_error) != 0) {
        return false;
    }
    png_set_read_fn(png, nullptr, PngReader::read);
    png_set_user_limits(png, 1u << 26, 1u << 26);
    png_read_info(png, info);
    pixels.width = png_get_image_width(png, info);
    pixels.height = png_get_image_height(png, info);
    if (std::uint64_t{pixels.width} * pixels.height > kMaxPixels) {
        PngReader::fail(png, "it has more than 2^26 pixels");
    }
    ask_for_rgb16(png, info);
    if (png_get_rowbytes(png, info) != std::size_t{6} * pixels.width) {
        PngReader::fail(png, "its rows are not of the size that its header says");
    }
    rgb.resize(std::size_t{3} * pixels.width * pixels.height);
    rows.resize(pixels.height);
    for (std::uint32_t y = 0; y < pixels.height; ++y) {
        rows[y] = reinterpret_cast<png_bytep>(rgb.data() + std::size_t{3} * pixels.width * y);
    }
    png_read_image(png, rows.data());
    png_read_end(png, nullptr);
    return true;
}

} // namespace

ImagePixels decode_png(const Path& path, const std::string& bytes, PixelKind kind) {
    PngReader reader;
    reader.next = reinterpret_cast<const unsigned char*>(bytes.data());
    reader.left = bytes.size();
    ImagePixels pixels;
    std::vector<std::uint16_t> rgb;
    std::vector<png_bytep> rows;
    png_structp png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, PngReader::fail, PngReader::warn);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    bool is_read = false;
    try {
        is_read = info != nullptr && decode(reader, png, info, pixels, rgb, rows);
    } catch (...) {
        png_destroy_read_struct(&png, &info, nullptr);
        throw;
    }
    png_destroy_read_struct(&png, &info, nullptr);
    if (!is_read) {
        fail_input(path, std::string("cannot be read as a PNG image: ") + reader.error);
    }
    if (kind == PixelKind::colour) {
        pixels.values = std::move(rgb);
        return pixels;
    }
    pixels.values.resize(rgb.size() / 3);
    for (std::size_t i = 0; i < pixels.values.size(); ++i) {
        pixels.values[i] = luminance(rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]);
    }
    return pixels;
}

} // namespace geodisk::tools
