// Numbers in messages.
#pragma once

#include <charconv>
#include <cmath>
#include <string>

namespace geodisk {

/// A large or small number for a message, three digits, the same in every locale.
inline std::string number_text(double value) {
    if (!std::isfinite(value)) {
        return "more than 1e308";
    }
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 3);
    return {text, end.ptr};
}

} // namespace geodisk
