// Small text helpers of the file readers. Numbers never depend on the locale.
#pragma once

#include <charconv>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace geodisk::tools {

/// Fills `tokens` with the parts of `line` between blanks and tabs.
void split_tokens(std::string_view line, std::vector<std::string_view>& tokens);

/// `text` without blanks and tabs at both ends.
std::string_view trimmed(std::string_view text);

/// All of `text` as a decimal number, nan or inf; nothing if it is anything else. A number too
/// big for a double is infinite, one too small is zero.
std::optional<double> parse_real(std::string_view text);

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

/// `text` in quotes for a one-line message: long text is cut, unprintable bytes become '?'.
std::string in_quotes(std::string_view text);

/// `text` as a cell of a CSV line, quoted where a reader would misunderstand it (RFC 4180).
std::string csv_cell(std::string_view text);

} // namespace geodisk::tools
