#include "common/number_text.hpp"

namespace geodisk::tools {
namespace {

std::string in_format(double value, std::chars_format format, int precision) {
    char digits[400]; // A double in fixed notation has up to 309 digits before the point.
    const auto result = std::to_chars(digits, digits + sizeof digits, value, format, precision);
    return {digits, result.ptr};
}

} // namespace

std::string rounded(double value, int digits) {
    return in_format(value, std::chars_format::general, digits);
}

std::string fixed(double value, int decimals) {
    return in_format(value, std::chars_format::fixed, decimals);
}

} // namespace geodisk::tools
