#include "program/arguments.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

[[noreturn]] void fail(const std::string& option, const std::string& text,
                       const std::string& message) {
    fail_usage(option + ": " + in_quotes(text) + " " + message);
}

} // namespace

Length parse_length(const std::string& option, const std::string& text) {
    Length length;
    std::string_view number = trimmed(text);
    if (number.ends_with('%')) {
        length.is_percent = true;
        number = trimmed(number.substr(0, number.size() - 1));
    }
    const std::optional<double> value = parse_real(number);
    if (!value) {
        fail(option, text,
             "is not a length; give mesh units like 0.25, or 1.5% of the bounding-box diagonal");
    }
    if (!(*value > 0) || !std::isfinite(*value)) {
        fail(option, text, "is not a positive, finite length");
    }
    length.value = *value;
    return length;
}

double parse_count(const std::string& option, const std::string& text) {
    const std::optional<double> value = parse_real(trimmed(text));
    if (!value || !(*value >= 1) || std::floor(*value) != *value) {
        fail(option, text, "is not a whole number of at least 1");
    }
    // Beyond 2^53 not every whole number is a double; no set is as large.
    if (*value > 0x1p53) {
        fail(option, text, "is above 2^53, more than any set has");
    }
    return *value;
}

double parse_ratio(const std::string& option, const std::string& text, double low, double high) {
    const std::optional<double> value = parse_real(trimmed(text));
    if (!value || !(*value >= low && *value <= high)) {
        fail(option, text, "is not a number of " + exact_text(low) + " to " + exact_text(high));
    }
    return *value;
}

std::uint64_t parse_seed(const std::string& option, const std::string& text) {
    std::string_view digits = trimmed(text);
    int base = 10;
    if (digits.starts_with("0x") || digits.starts_with("0X")) {
        digits.remove_prefix(2);
        base = 16;
    }
    std::uint64_t seed = 0;
    const char* const end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, seed, base);
    if (error != std::errc{} || stop != end) {
        fail(option, text, "is not a whole number of 0 to 2^64 - 1, decimal or with 0x");
    }
    return seed;
}

double parse_units(const std::string& option, const std::string& text) {
    constexpr std::pair<std::string_view, double> kUnits[] = {
        {"mm", 0.001}, {"cm", 0.01}, {"m", 1}, {"km", 1000}, {"in", 0.0254}, {"ft", 0.3048}};
    for (const auto& [name, metres] : kUnits) {
        if (text == name) {
            return metres;
        }
    }
    const std::optional<double> value = parse_positive(trimmed(text));
    if (!value) {
        fail(option, text, "is neither mm, cm, m, km, in or ft, nor a positive number of metres");
    }
    return *value;
}

std::uint64_t parse_bytes(const std::string& option, const std::string& text) {
    std::string_view number = trimmed(text);
    double factor = 1;
    constexpr std::string_view kSuffixes = "KMG";
    if (!number.empty()) {
        const std::size_t power = kSuffixes.find(number.back());
        if (power != std::string_view::npos) {
            factor = std::ldexp(1.0, 10 * (static_cast<int>(power) + 1));
            number = trimmed(number.substr(0, number.size() - 1));
        }
    }
    const std::optional<double> value = parse_real(number);
    constexpr double kMax = 0x1p50; // A pebibyte: more than any device, and exact as a double.
    if (!value || !(*value * factor >= 1 && *value * factor <= kMax)) {
        fail(option, text, "is not a size in bytes; give a number like 256M, with K, M or G");
    }
    return static_cast<std::uint64_t>(*value * factor);
}

} // namespace geodisk::tools
