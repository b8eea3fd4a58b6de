// Numbers as a page carries them: typed arrays of JavaScript, in base64.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace geodisk::tools::report {

/// `bytes` are the numbers, little-endian. A fraction n of 65535 stands for low + n (high - low);
/// where these are equal, as in all other arrays, numbers are what they are.
struct PageArray {
    std::string name;
    std::string_view type; ///< JavaScript's: Uint8Array, Uint16Array, Uint32Array, Float32Array or
                           ///< Float64Array.
    std::size_t count = 0;
    std::string bytes;
    double low = 0, high = 0;
};

/// In as few bytes each as the largest takes.
PageArray whole_numbers(std::string name, std::span<const std::uint32_t> numbers);

PageArray real_numbers(std::string name, std::span<const float> numbers);

/// Lengths of any unit: as floats, or as doubles where one is too small or too large for a float.
PageArray lengths(std::string name, std::span<const double> numbers);

/// Numbers of [low, high], low < high, to the nearest of 65536 that are evenly spaced there.
PageArray rounded_numbers(std::string name, std::span<const double> numbers, double low,
                          double high);

/// Half the distance of two numbers next to each other in such an array: no number is farther off.
constexpr double rounding_error(double low, double high) {
    return (high - low) / 65535 / 2;
}

/// RFC 4648, with padding.
std::string base64_of(std::string_view bytes);

} // namespace geodisk::tools::report
