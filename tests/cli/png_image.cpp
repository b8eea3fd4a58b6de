#include "cli/png_image.hpp"

#include <cstring>
#include <string>

#include <doctest/doctest.h>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace geodisk::test {

PngImage read_png(const std::filesystem::path& path) {
    PngImage image;
    int channels = 0;
    stbi_uc* const data =
        stbi_load(path.string().c_str(), &image.width, &image.height, &channels, 4);
    REQUIRE(data != nullptr);
    image.pixels.resize(static_cast<std::size_t>(image.width) *
                        static_cast<std::size_t>(image.height));
    std::memcpy(image.pixels.data(), data, image.pixels.size() * sizeof(Pixel));
    stbi_image_free(data);
    return image;
}

} // namespace geodisk::test
