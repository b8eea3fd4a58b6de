// Numbers and names as people read them, whatever the locale.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include <geodisk/device.hpp>

#include "program/safe_text.hpp"

namespace geodisk::tools {

/// Rounded to `digits` significant digits, without trailing zeros.
std::string rounded(double value, int digits);

/// Rounded to this many digits after the point.
std::string fixed(double value, int decimals);

/// "1,234,567".
std::string grouped(std::uint64_t value);

/// "1 vertex" or "1,234 vertices".
std::string counted(std::uint64_t value, std::string_view one, std::string_view many);

/// "12 ms", "1.23 s" or "4 min 5 s".
std::string seconds_text(double seconds);

/// Bytes with a binary unit, rounded to one decimal.
std::string size_text(std::uint64_t bytes);

const char* type_name(VkPhysicalDeviceType type);

/// A UUID in the usual form, which `--device` accepts.
std::string uuid_text(const std::array<std::uint8_t, VK_UUID_SIZE>& uuid);

/// The driver's name and version, as far as it tells.
std::string driver_text(const DeviceReport& report);

/// `text` and blanks, together at least `width` wide.
std::string padded(std::string text, std::size_t width);

/// Returns `text` with line breaks for blanks, so that no line is longer than `width` if words
/// allow.
std::string wrapped(std::string text, std::size_t width = 64);

/// Returns `text` in quotes for a one-line message: long text is cut, and '?' stands for line
/// breaks and what else one_line() keeps away.
std::string in_quotes(std::string_view text);

} // namespace geodisk::tools
