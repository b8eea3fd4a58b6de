#include "picture/png.hpp"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <memory>
#include <utility>
#include <vector>

#include "files/archives/checksum.hpp"
#include "program/failure.hpp"

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace geodisk::tools::picture {
namespace {

/// Sink that stb calls with the file; an exception must not pass through it.
struct Sink {
    std::string bytes{};
    std::exception_ptr error{};
};

void take_bytes(void* context, void* data, int size) {
    Sink& sink = *static_cast<Sink*>(context);
    try {
        sink.bytes.append(static_cast<const char*>(data), static_cast<std::size_t>(size));
    } catch (...) {
        sink.error = std::current_exception();
    }
}

// Names the filter of a row: each byte is the difference from that of the pixel before.
constexpr char kSubFilter = 1;

void append_big_endian(std::string& bytes, std::uint32_t value) {
    for (const int shift : {24, 16, 8, 0}) {
        bytes += static_cast<char>(value >> shift);
    }
}

void append_difference(std::string& bytes, std::uint16_t value, std::uint16_t& before) {
    bytes += static_cast<char>((value >> 8) - (before >> 8));
    bytes += static_cast<char>(value - before);
    before = value;
}

/// Returns a chunk of a type and its content.
std::string chunk(const std::string& typed) {
    std::string bytes;
    append_big_endian(bytes, static_cast<std::uint32_t>(typed.size() - 4));
    bytes += typed;
    append_big_endian(bytes, crc32_of(typed));
    return bytes;
}

[[noreturn]] void fail_for_memory() {
    throw UserError(ExitCode::out_of_memory, "the host has too little memory for the picture");
}

std::string compressed(std::string& bytes) {
    constexpr int kQuality = 8; // As stb has it for pictures.
    int size = 0;
    const std::unique_ptr<unsigned char, decltype(&std::free)> data(
        stbi_zlib_compress(reinterpret_cast<unsigned char*>(bytes.data()),
                           static_cast<int>(bytes.size()), &size, kQuality),
        &std::free);
    if (!data) {
        fail_for_memory();
    }
    return {reinterpret_cast<const char*>(data.get()), static_cast<std::size_t>(size)};
}

} // namespace

std::string png_of(const Pixels& pixels) {
    const std::size_t count = std::size_t{pixels.width} * pixels.height;
    bool is_opaque = true;
    for (std::size_t i = 0; i < count; ++i) {
        is_opaque = is_opaque && pixels.rgba[4 * i + 3] == 255;
    }
    std::vector<std::uint8_t> rgb;
    if (is_opaque) {
        rgb.reserve(3 * count);
        for (std::size_t i = 0; i < count; ++i) {
            rgb.insert(rgb.end(), &pixels.rgba[4 * i], &pixels.rgba[4 * i] + 3);
        }
    }
    Sink sink;
    const int channels = is_opaque ? 3 : 4;
    const int written = stbi_write_png_to_func(take_bytes, &sink, static_cast<int>(pixels.width),
                                               static_cast<int>(pixels.height), channels,
                                               is_opaque ? rgb.data() : pixels.rgba.data(), 0);
    if (sink.error) {
        std::rethrow_exception(sink.error);
    }
    if (written == 0) {
        fail_for_memory();
    }
    return std::move(sink.bytes);
}

std::string png_of(const DeepPixels& pixels) {
    const bool is_opaque = std::ranges::all_of(pixels.texels, &DeepPixels::Texel::is_opaque);
    const std::size_t width = pixels.width, channels = is_opaque ? 1 : 2,
                      row = 1 + 2 * channels * width;
    std::string rows;
    rows.reserve(row * pixels.height);
    for (std::size_t y = 0; y < pixels.height; ++y) {
        rows += kSubFilter;
        std::uint16_t before = 0, alpha_before = 0;
        for (std::size_t x = 0; x < width; ++x) {
            const DeepPixels::Texel& texel = pixels.texels[y * width + x];
            append_difference(rows, texel.grey, before);
            if (!is_opaque) {
                append_difference(rows, texel.alpha(), alpha_before);
            }
        }
    }
    std::string size;
    append_big_endian(size, pixels.width);
    append_big_endian(size, pixels.height);
    const char kinds[] = {16, static_cast<char>(is_opaque ? 0 : 4), 0, 0, 0};
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR" + size + std::string(kinds, sizeof(kinds))) +
           chunk("IDAT" + compressed(rows)) + chunk("IEND");
}

void write_png(AtomicFile& file, const Pixels& pixels) {
    file.write(png_of(pixels));
}

} // namespace geodisk::tools::picture
