// PNG files of grey images, stored without compression.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace geodisk::tools {

inline std::string big_endian(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) {
        bytes += static_cast<char>(value >> shift & 0xffu);
    }
    return bytes;
}

inline std::string png_chunk(std::string_view type, std::string_view data) {
    const std::string content = std::string(type) + std::string(data);
    std::uint32_t crc = ~0u;
    for (const char c : content) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) {
            crc = crc >> 1 ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
        }
    }
    return big_endian(static_cast<std::uint32_t>(data.size())) + content + big_endian(~crc);
}

/// Returns `data`, of less than 64 KiB, as zlib stores it.
inline std::string zlib_bytes(std::string_view data) {
    std::uint32_t a = 1, b = 0;
    for (const char c : data) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<std::uint32_t>(data.size());
    std::string stored = "\x78\x01\x01";
    for (const std::uint32_t word : {size, ~size}) {
        stored += static_cast<char>(word & 0xffu);
        stored += static_cast<char>(word >> 8 & 0xffu);
    }
    return stored + std::string(data) + big_endian(b << 16 | a);
}

/// `pixels` holds `bits` (8 or 16, big endian) per pixel and channel, row by row from above;
/// `color` is PNG's: 0 for grey, 2 for RGB. Less than 64 KiB in all.
inline std::string png_bytes(std::uint32_t width, std::uint32_t height, std::string_view pixels,
                             char bits = 8, char color = 0) {
    const std::size_t row = pixels.size() / height;
    std::string rows;
    for (std::uint32_t y = 0; y < height; ++y) {
        rows += std::string(1, '\0') + std::string(pixels.substr(y * row, row));
    }
    const std::string header =
        big_endian(width) + big_endian(height) + std::string{bits, color, '\0', '\0', '\0'};
    return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + png_chunk("IDAT", zlib_bytes(rows)) +
           png_chunk("IEND", "");
}

} // namespace geodisk::tools
