// Pictures that a command wrote.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace geodisk::test {

struct Pixel {
    std::uint8_t red, green, blue, alpha;
    friend bool operator==(const Pixel&, const Pixel&) = default;
};

struct PngImage {
    int width = 0, height = 0;
    std::vector<Pixel> pixels; ///< Row by row from the top.
};

/// Fails the test if `path` is no PNG file.
PngImage read_png(const std::filesystem::path& path);

} // namespace geodisk::test
