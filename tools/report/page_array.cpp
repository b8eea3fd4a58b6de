#include "report/page_array.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace geodisk::tools::report {
namespace {

void append_bytes(std::string& bytes, std::uint64_t number, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        bytes.push_back(static_cast<char>(number >> 8 * i & 0xff));
    }
}

template <class Number>
PageArray array_of(std::string name, std::string_view type, std::size_t width,
                   std::span<const Number> numbers) {
    PageArray array{std::move(name), type, numbers.size(), {}};
    array.bytes.reserve(width * numbers.size());
    for (const Number number : numbers) {
        append_bytes(array.bytes, number, width);
    }
    return array;
}

} // namespace

PageArray whole_numbers(std::string name, std::span<const std::uint32_t> numbers) {
    const auto largest = std::max_element(numbers.begin(), numbers.end());
    const std::uint32_t most = largest == numbers.end() ? 0 : *largest;
    return most <= 0xff     ? array_of(std::move(name), "Uint8Array", 1, numbers)
           : most <= 0xffff ? array_of(std::move(name), "Uint16Array", 2, numbers)
                            : array_of(std::move(name), "Uint32Array", 4, numbers);
}

PageArray real_numbers(std::string name, std::span<const float> numbers) {
    std::vector<std::uint32_t> bits;
    bits.reserve(numbers.size());
    for (const float number : numbers) {
        bits.push_back(std::bit_cast<std::uint32_t>(number));
    }
    return array_of<std::uint32_t>(std::move(name), "Float32Array", 4, bits);
}

PageArray lengths(std::string name, std::span<const double> numbers) {
    using Float = std::numeric_limits<float>;
    if (std::ranges::all_of(numbers, [](double length) {
            return length == 0 ||
                   (length >= double{Float::min()} && length <= double{Float::max()});
        })) {
        std::vector<float> floats;
        floats.reserve(numbers.size());
        for (const double number : numbers) {
            floats.push_back(static_cast<float>(number));
        }
        return real_numbers(std::move(name), floats);
    }
    std::vector<std::uint64_t> bits;
    bits.reserve(numbers.size());
    for (const double number : numbers) {
        bits.push_back(std::bit_cast<std::uint64_t>(number));
    }
    return array_of<std::uint64_t>(std::move(name), "Float64Array", 8, bits);
}

PageArray rounded_numbers(std::string name, std::span<const double> numbers, double low,
                          double high) {
    std::vector<std::uint32_t> parts;
    parts.reserve(numbers.size());
    for (const double number : numbers) {
        const double part = std::clamp((number - low) / (high - low), 0.0, 1.0);
        parts.push_back(static_cast<std::uint32_t>(std::lround(65535 * part)));
    }
    PageArray array = array_of<std::uint32_t>(std::move(name), "Uint16Array", 2, parts);
    array.low = low;
    array.high = high;
    return array;
}

std::string base64_of(std::string_view bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
        std::uint32_t group = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto byte = i < count ? static_cast<unsigned char>(bytes[at + i]) : 0u;
            group = group << 8 | byte;
        }
        for (std::size_t i = 0; i < 4; ++i) {
            text.push_back(i <= count ? kDigits[group >> (18 - 6 * i) & 63] : '=');
        }
    }
    return text;
}

} // namespace geodisk::tools::report
