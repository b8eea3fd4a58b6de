// Numbers of typed arrays, as the script of a page reads them.
#pragma once

#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace geodisk::test {

/// Those of `bytes`, of the type of JavaScript, where a fraction stands for a number of [low, high]
/// if these differ. Throws for bytes that are not so many numbers.
inline std::vector<double> typed_numbers(std::string_view type, std::string_view bytes,
                                         std::size_t count, double low, double high) {
    const std::size_t width = type == "Uint8Array"     ? 1
                              : type == "Uint16Array"  ? 2
                              : type == "Float64Array" ? 8
                                                       : 4;
    if (bytes.size() != width * count) {
        throw std::runtime_error("an array is not as long as it says");
    }
    std::vector<double> numbers;
    for (std::size_t at = 0; at < bytes.size(); at += width) {
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < width; ++i) {
            bits |= std::uint64_t{static_cast<unsigned char>(bytes[at + i])} << 8 * i;
        }
        const auto whole = static_cast<std::uint32_t>(bits);
        numbers.push_back(type == "Float64Array"   ? std::bit_cast<double>(bits)
                          : type == "Float32Array" ? std::bit_cast<float>(whole)
                          : low < high             ? low + whole / 65535.0 * (high - low)
                                                   : whole);
    }
    return numbers;
}

} // namespace geodisk::test
