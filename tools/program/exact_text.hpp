// Text for programs: numbers in full and back, tokens. The same in every locale.
#pragma once

#include <charconv>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace geodisk::tools {

/// Appends the shortest decimal form that reads back as the same number.
template <typename Number>
void append_number(std::string& text, Number value) {
    char digits[32];
    const std::to_chars_result result = std::to_chars(digits, digits + sizeof digits, value);
    text.append(digits, static_cast<std::size_t>(result.ptr - digits));
}

/// The same as a text of its own.
template <typename Number>
std::string exact_text(Number value) {
    std::string text;
    append_number(text, value);
    return text;
}

/// Appends the parts of `line` between blanks and tabs to `tokens`.
void append_tokens(std::string_view line, std::vector<std::string_view>& tokens);

/// Replaces `tokens` with the parts of `line` between blanks and tabs.
void split_tokens(std::string_view line, std::vector<std::string_view>& tokens);

/// Returns the parts of `text` between commas, empty ones as well; none of "".
std::vector<std::string> parts_of(std::string_view text);

/// `text` without blanks and tabs at both ends.
std::string_view trimmed(std::string_view text);

/// All of `text` as a decimal number, nan or inf, also as "1.#IND" and "1.#INF"; nothing if it is
/// anything else. A number too big for a double is infinite, one too small is zero.
std::optional<double> parse_real(std::string_view text);

/// All of `text` as such a number if it is positive and finite.
std::optional<double> parse_positive(std::string_view text);

/// All of `text` as a decimal integer; nothing if it is anything else or does not fit.
template <std::integral Integer>
std::optional<Integer> parse_integer(std::string_view text) {
    Integer value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end) {
        return std::nullopt;
    }
    return value;
}

} // namespace geodisk::tools
