#include "program/exact_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

namespace geodisk::tools {

void append_tokens(std::string_view line, std::vector<std::string_view>& tokens) {
    // find_first_of() calls a function for each character, which takes longer than the rest.
    const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
    const char* const end = line.data() + line.size();
    const char* at = line.data();
    while (true) {
        at = std::find_if_not(at, end, is_blank);
        if (at == end) {
            return;
        }
        const char* const begin = std::exchange(at, std::find_if(at, end, is_blank));
        tokens.emplace_back(begin, static_cast<std::size_t>(at - begin));
    }
}

void split_tokens(std::string_view line, std::vector<std::string_view>& tokens) {
    tokens.clear();
    append_tokens(line, tokens);
}

std::vector<std::string> parts_of(std::string_view text) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= text.size() && !text.empty();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        parts.emplace_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t");
    if (begin == std::string_view::npos) {
        return {};
    }
    return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

namespace {

/// std::from_chars reports "too big" and "too small" alike; the digits tell which.
double out_of_range_value(std::string_view text) {
    const bool negative = text.starts_with('-');
    const std::size_t exponent = text.find_first_of("eE");
    const bool small = exponent != std::string_view::npos
                           ? text.substr(exponent + 1).starts_with('-')
                           : text.find_first_of("123456789") > text.find('.');
    const double magnitude = small ? 0.0 : std::numeric_limits<double>::infinity();
    return negative ? -magnitude : magnitude;
}

} // namespace

namespace {

/// The value of what old C libraries of Windows print for numbers that are not finite: "1.#IND",
/// "1.#QNAN0", "1.#INF00" and so on.
std::optional<double> windows_value(std::string_view text) {
    const bool is_negative = text.starts_with('-');
    text.remove_prefix(is_negative ? 1 : 0);
    if (!text.starts_with("1.#")) {
        return std::nullopt;
    }
    text.remove_prefix(3);
    const std::string_view name = text.substr(0, text.find('0'));
    if (text.find_first_not_of('0', name.size()) != std::string_view::npos) {
        return std::nullopt;
    }
    using Limits = std::numeric_limits<double>;
    if (name == "INF" || name == "J") { // J where the last digit of INF was rounded.
        return is_negative ? -Limits::infinity() : Limits::infinity();
    }
    return name == "IND" || name == "QNAN" || name == "SNAN" ? std::optional(Limits::quiet_NaN())
                                                             : std::nullopt;
}

} // namespace

std::optional<double> parse_real(std::string_view text) {
    if (text.starts_with('+')) {
        text.remove_prefix(1);
        if (text.starts_with('-')) {
            return std::nullopt;
        }
    }
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc::invalid_argument || stop != end) {
        return windows_value(text);
    }
    return error == std::errc::result_out_of_range ? out_of_range_value(text) : value;
}

std::optional<double> parse_positive(std::string_view text) {
    const std::optional<double> value = parse_real(text);
    return value && *value > 0 && std::isfinite(*value) ? value : std::nullopt;
}

} // namespace geodisk::tools
