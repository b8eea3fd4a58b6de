// The byte order of the binary files that are written.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

namespace geodisk::tools {

template <typename Value>
void append_little_endian(std::string& bytes, Value value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if constexpr (std::endian::native == std::endian::big) {
        std::reverse(raw, raw + sizeof raw);
    }
    bytes.append(raw, sizeof raw);
}

} // namespace geodisk::tools
