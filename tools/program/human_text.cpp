#include "program/human_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <utility>

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

std::string grouped(std::uint64_t value) {
    std::string text = std::to_string(value);
    for (std::size_t end = text.size(); end > 3; end -= 3) {
        text.insert(end - 3, 1, ',');
    }
    return text;
}

std::string counted(std::uint64_t value, std::string_view one, std::string_view many) {
    return grouped(value) + ' ' + std::string(value == 1 ? one : many);
}

std::string seconds_text(double seconds) {
    if (seconds < 0.9995) {
        return fixed(1000 * seconds, seconds < 0.00995 ? 1 : 0) + " ms";
    }
    if (seconds < 60) {
        return fixed(seconds, seconds < 9.995 ? 2 : 1) + " s";
    }
    const auto whole = static_cast<std::uint64_t>(seconds);
    return grouped(whole / 60) + " min " + std::to_string(whole % 60) + " s";
}

std::string size_text(std::uint64_t bytes) {
    static constexpr const char* kUnits[] = {"bytes", "KiB", "MiB", "GiB", "TiB"};
    double value = static_cast<double>(bytes);
    std::size_t unit = 0;
    while (value >= 1024.0 && unit + 1 < std::size(kUnits)) {
        value /= 1024.0;
        ++unit;
    }
    const int decimals = value == std::floor(value) ? 0 : 1;
    return fixed(value, decimals) + ' ' + kUnits[unit];
}

const char* type_name(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return "discrete GPU";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return "integrated GPU";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return "virtual GPU";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return "CPU";
    default:
        return "other";
    }
}

std::string uuid_text(const std::array<std::uint8_t, VK_UUID_SIZE>& uuid) {
    static constexpr char kDigits[] = "0123456789abcdef";
    std::string text;
    for (std::size_t i = 0; i < uuid.size(); ++i) {
        if (i == 4 || i == 6 || i == 8 || i == 10)
            text += '-';
        text += kDigits[uuid[i] >> 4];
        text += kDigits[uuid[i] & 15];
    }
    return text;
}

std::string driver_text(const DeviceReport& report) {
    if (report.driver_name.empty()) {
        return "version " + std::to_string(report.driver_version);
    }
    return report.driver_info.empty() ? report.driver_name
                                      : report.driver_name + ", " + report.driver_info;
}

std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(text.size(), width), ' ');
    return text;
}

std::string wrapped(std::string text, std::size_t width) {
    std::size_t begin = 0, last = std::string::npos; // Of a line, and its last blank.
    for (std::size_t i = 0; i < text.size(); ++i) {
        last = text[i] == ' ' ? i : last;
        if (i - begin >= width && last != std::string::npos) {
            text[last] = '\n';
            begin = std::exchange(last, std::string::npos) + 1;
        }
    }
    return text;
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t kLongest = 40; // Characters; a stray byte is one.
    std::size_t end = 0;
    for (std::size_t count = 0; count < kLongest && end < text.size(); ++count) {
        end += std::max<std::size_t>(1, character_size(text.substr(end)));
    }
    std::string shown(text.substr(0, end));
    std::replace_if(
        shown.begin(), shown.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; },
        '?');
    std::string result(1, '\'');
    result += plain_lines(shown);
    return result + (end < text.size() ? "...'" : "'");
}

} // namespace geodisk::tools
