#include "picture/png.hpp"

#include <exception>
#include <utility>
#include <vector>

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
        throw UserError(ExitCode::out_of_memory, "the host has too little memory for the picture");
    }
    return std::move(sink.bytes);
}

void write_png(AtomicFile& file, const Pixels& pixels) {
    file.write(png_of(pixels));
}

} // namespace geodisk::tools::picture
