#include <csetjmp>
#include <cstdio> // Which jpeglib.h wants before it.

#include <jpeglib.h>

#include "files/images/image_pixels.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

/// Maximum of scans of a progressive image: each can take as long as the first.
constexpr int kMaxScans = 100;

/// State that libjpeg's callbacks share. libjpeg ends on errors by a jump, over which nothing may
/// live that has a destructor.
struct JpegReader {
    jpeg_decompress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf on_error;
    char error[JMSG_LENGTH_MAX] = {};

    static JpegReader& of(j_common_ptr jpeg) {
        return *static_cast<JpegReader*>(jpeg->client_data);
    }

    [[noreturn]] static void fail(j_common_ptr jpeg) {
        JpegReader& reader = of(jpeg);
        jpeg->err->format_message(jpeg, reader.error);
        std::longjmp(reader.on_error, 1);
    }

    [[noreturn]] static void fail_with(j_common_ptr jpeg, const char* message) {
        std::snprintf(of(jpeg).error, sizeof of(jpeg).error, "%s", message);
        std::longjmp(of(jpeg).on_error, 1);
    }

    /// Warnings, of level -1, are of damaged data that libjpeg makes up.
    static void hear(j_common_ptr jpeg, int level) {
        if (level < 0) {
            fail(jpeg);
        }
    }

    static void count_scans(j_common_ptr jpeg) {
        if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number > kMaxScans) {
            fail_with(jpeg, "it has too many scans");
        }
    }
};

/// Returns the number of values per pixel that libjpeg gives. It does not convert inks to colours.
std::size_t ask_for_colours(jpeg_decompress_struct& jpeg, PixelKind kind) {
    if (jpeg.jpeg_color_space == JCS_CMYK || jpeg.jpeg_color_space == JCS_YCCK) {
        jpeg.out_color_space = JCS_CMYK;
        return 4;
    }
    jpeg.out_color_space = kind == PixelKind::grey ? JCS_GRAYSCALE : JCS_RGB;
    return kind == PixelKind::grey ? 1 : 3;
}

/// Adds the colour or grey of four inks, which programs of Adobe store inverted.
void add_inks(const unsigned char* inks, bool is_inverted, PixelKind kind,
              std::vector<std::uint16_t>& values) {
    constexpr std::uint32_t kMax = 255;
    std::uint32_t colour[3];
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t ink = is_inverted ? inks[i] : kMax - inks[i];
        const std::uint32_t black = is_inverted ? inks[3] : kMax - inks[3];
        colour[i] = 257 * ((ink * black + kMax / 2) / kMax);
    }
    if (kind == PixelKind::grey) {
        values.push_back(luminance(colour[0], colour[1], colour[2]));
    } else {
        for (const std::uint32_t value : colour) {
            values.push_back(static_cast<std::uint16_t>(value));
        }
    }
}

/// False on an error, which `reader` has the text of.
bool decode(JpegReader& reader, const std::string& bytes, PixelKind kind, ImagePixels& pixels,
            std::vector<unsigned char>& row) {
    jpeg_decompress_struct& jpeg = reader.jpeg;
    if (setjmp(reader.on_error) != 0) {
        return false;
    }
    jpeg_create_decompress(&jpeg);
    jpeg.progress = &reader.progress;
    jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&jpeg, TRUE);
    if (std::uint64_t{jpeg.image_width} * jpeg.image_height > kMaxPixels) {
        JpegReader::fail_with(reinterpret_cast<j_common_ptr>(&jpeg),
                              "it has more than 2^26 pixels");
    }
    const std::size_t components = ask_for_colours(jpeg, kind);
    jpeg.dct_method = JDCT_ISLOW; // The same bits everywhere.
    jpeg_start_decompress(&jpeg);
    pixels.width = jpeg.output_width;
    pixels.height = jpeg.output_height;
    row.resize(components * pixels.width);
    pixels.values.reserve(std::size_t{pixels.width} * pixels.height *
                          (kind == PixelKind::grey ? 1 : 3));
    while (jpeg.output_scanline < jpeg.output_height) {
        JSAMPROW rows[1] = {row.data()};
        jpeg_read_scanlines(&jpeg, rows, 1);
        if (components == 4) {
            for (std::size_t i = 0; i < row.size(); i += components) {
                add_inks(&row[i], jpeg.saw_Adobe_marker != 0, kind, pixels.values);
            }
            continue;
        }
        for (const unsigned char value : row) {
            pixels.values.push_back(static_cast<std::uint16_t>(257 * value));
        }
    }
    jpeg_finish_decompress(&jpeg);
    return true;
}

} // namespace

ImagePixels decode_jpeg(const Path& path, const std::string& bytes, PixelKind kind) {
    JpegReader reader;
    reader.jpeg.err = jpeg_std_error(&reader.errors);
    reader.errors.error_exit = JpegReader::fail;
    reader.errors.emit_message = JpegReader::hear;
    reader.progress.progress_monitor = JpegReader::count_scans;
    reader.jpeg.client_data = &reader;
    ImagePixels pixels;
    std::vector<unsigned char> row;
    bool is_read = false;
    try {
        is_read = decode(reader, bytes, kind, pixels, row);
    } catch (...) {
        jpeg_destroy_decompress(&reader.jpeg);
        throw;
    }
    jpeg_destroy_decompress(&reader.jpeg);
    if (!is_read) {
        fail_input(path, std::string("cannot be read as a JPEG image: ") + reader.error);
    }
    return pixels;
}

} // namespace geodisk::tools
