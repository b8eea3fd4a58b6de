// Numbers as text: all their digits for files, fewer for people; the same in every locale.
#pragma once

#include <charconv>
#include <string>

namespace geodisk::tools {

/// Appends the shortest decimal form that reads back as the same number.
template <typename Number>
void append_number(std::string& text, Number value) {
    char digits[32];
    const std::to_chars_result result = std::to_chars(digits, digits + sizeof digits, value);
    text.append(digits, result.ptr);
}

/// The same as a text of its own.
template <typename Number>
std::string exact_text(Number value) {
    std::string text;
    append_number(text, value);
    return text;
}

/// Rounded to `digits` significant digits, without trailing zeros.
std::string rounded(double value, int digits);

/// Rounded to this many digits after the point.
std::string fixed(double value, int decimals);

} // namespace geodisk::tools
