// Numbers in messages, the same in every locale.
#pragma once

#include <charconv>
#include <cmath>
#include <string>

namespace geodisk {

/// Returns a number with three digits.
inline std::string number_text(double value) {
    if (std::isnan(value)) {
        return "nan";
    }
    if (!std::isfinite(value)) {
        return "more than 1e308";
    }
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 3);
    return {text, end.ptr};
}

/// Returns the shortest text that reads back as the same number.
inline std::string exact_text(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

} // namespace geodisk
