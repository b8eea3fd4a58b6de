// Numbers as the bytes of binary files.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>
#include <string>

namespace geodisk::tools {

/// Returns the number whose bytes begin at `bytes`, the lowest first if `is_little`.
template <typename Value>
Value value_of_bytes(const char* bytes, bool is_little = true) {
    char raw[sizeof(Value)];
    std::copy(bytes, bytes + sizeof raw, raw);
    if (is_little != (std::endian::native == std::endian::little)) {
        std::reverse(raw, raw + sizeof raw);
    }
    Value value;
    std::memcpy(&value, raw, sizeof value);
    return value;
}

/// Returns the same as a double, which holds all but large integers exactly.
template <typename Value>
double number_of_bytes(const char* bytes, bool is_little = true) {
    return static_cast<double>(value_of_bytes<Value>(bytes, is_little));
}

/// Puts the numbers of values that follow each other into `out`, one for each of its elements.
template <typename Value>
void numbers_of_bytes(const char* bytes, bool is_little, std::span<double> out) {
    for (double& number : out) {
        number = number_of_bytes<Value>(bytes, is_little);
        bytes += sizeof(Value);
    }
}

/// Stores a value as the binary files that are written have it.
template <typename Byte, typename Value>
void store_little_endian(Byte* out, Value value) {
    std::memcpy(out, &value, sizeof value);
    if constexpr (std::endian::native == std::endian::big) {
        std::reverse(out, out + sizeof value);
    }
}

/// Appends a value in the same way.
template <typename Value>
void append_little_endian(std::string& bytes, Value value) {
    char raw[sizeof value];
    store_little_endian(raw, value);
    bytes.append(raw, sizeof raw);
}

} // namespace geodisk::tools
