#include "files/base64.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace geodisk::tools {
namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t kNoDigit = 255, kBlank = 254, kFiller = 253;

constexpr std::array<std::uint8_t, 256> make_values() {
    std::array<std::uint8_t, 256> values{};
    values.fill(kNoDigit);
    for (std::size_t i = 0; i < kDigits.size(); ++i) {
        values[static_cast<unsigned char>(kDigits[i])] = static_cast<std::uint8_t>(i);
    }
    values['-'] = 62; // As in URLs.
    values['_'] = 63;
    values['='] = kFiller;
    for (const char blank : {' ', '\t', '\r', '\n'}) {
        values[static_cast<unsigned char>(blank)] = kBlank;
    }
    return values;
}

constexpr std::array<std::uint8_t, 256> kValues = make_values();
constexpr unsigned kBitsOfDigit = 6;

} // namespace

std::optional<std::string> from_base64(std::string_view text, std::size_t count) {
    std::string bytes;
    bytes.reserve(std::min(count, text.size() / 4 * 3 + 2));
    std::uint32_t bits = 0;
    unsigned left = 0; // Number of bits.
    for (std::size_t i = 0; i < text.size() && bytes.size() < count; ++i) {
        const std::uint8_t value = kValues[static_cast<unsigned char>(text[i])];
        if (value == kBlank) {
            continue;
        }
        if (value == kNoDigit || (value == kFiller && left == kBitsOfDigit)) {
            return std::nullopt;
        }
        if (value == kFiller) {
            left = 0;
            continue;
        }
        bits = bits << kBitsOfDigit | value;
        left += kBitsOfDigit;
        if (left >= 8) {
            left -= 8;
            bytes += static_cast<char>(bits >> left & 0xffu);
        }
    }
    return left == kBitsOfDigit ? std::nullopt : std::optional(std::move(bytes));
}

void append_base64(std::string& text, std::string_view bytes) {
    text.reserve(text.size() + (bytes.size() + 2) / 3 * 4);
    for (; !bytes.empty(); bytes.remove_prefix(std::min<std::size_t>(bytes.size(), 3))) {
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            bits = bits << 8 | (i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u);
        }
        for (std::size_t i = 0; i < 4; ++i) {
            text += i <= bytes.size() ? kDigits[bits >> (18 - 6 * i) & 63] : '=';
        }
    }
}

} // namespace geodisk::tools
