// select_device: finds the device that a name means.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <system_error>

#include <geodisk/context.hpp>

#include "support/guard.hpp"

namespace geodisk {
namespace {

using Uuid = std::array<std::uint8_t, VK_UUID_SIZE>;
using Reports = std::span<const DeviceReport>;

/// Returns the rank of a device type; lower is better.
int rank_of(VkPhysicalDeviceType type) noexcept {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return 3;
    default:
        return 4;
    }
}

// Lower case, independent of the locale.
char lower(char c) noexcept {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool contains_ignoring_case(std::string_view text, std::string_view part) noexcept {
    const auto same = [](char a, char b) { return lower(a) == lower(b); };
    return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

std::optional<Uuid> parse_uuid(std::string_view text) {
    std::string digits(text);
    std::erase(digits, '-');
    Uuid uuid{};
    if (digits.size() != 2 * uuid.size())
        return std::nullopt;
    for (std::size_t i = 0; i < uuid.size(); ++i) {
        const char* begin = digits.data() + 2 * i;
        if (std::from_chars(begin, begin + 2, uuid[i], 16).ptr != begin + 2)
            return std::nullopt;
    }
    return uuid;
}

/// Returns the number that the text is, if it is one.
std::optional<std::size_t> parse_number(std::string_view text) noexcept {
    std::size_t number = 0;
    const char* end = text.data() + text.size();
    const auto [last, failure] = std::from_chars(text.data(), end, number);
    return failure == std::errc{} && last == end ? std::optional(number) : std::nullopt;
}

/// Larger numbers may be a part of a name, as 4090.
constexpr std::size_t kMaxIndex = 99;

template <class Predicate>
std::vector<std::size_t> indices_where(Reports reports, Predicate matches) {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < reports.size(); ++i) {
        if (matches(reports[i]))
            indices.push_back(i);
    }
    return indices;
}

std::vector<std::size_t> find_matches(Reports reports, std::string_view device) {
    if (const std::optional<Uuid> uuid = parse_uuid(device)) {
        std::vector<std::size_t> matches = indices_where(
            reports, [&](const DeviceReport& report) { return report.uuid == *uuid; });
        if (!matches.empty())
            return matches;
    }
    if (const std::optional<std::size_t> number = parse_number(device)) {
        if (*number < reports.size())
            return {*number};
        if (*number <= kMaxIndex) // Digits of versions in names are none.
            return {};
    }
    return indices_where(reports, [&](const DeviceReport& report) {
        return device.empty() || contains_ignoring_case(report.name, device);
    });
}

std::string in_quotation_marks(std::string_view text) {
    std::string result = "\"";
    result += text;
    result += '"';
    return result;
}

Error nothing_matches(Reports reports, std::string_view device) {
    if (reports.empty())
        return Error{Status::no_device, "there is no Vulkan device"};
    std::string message = "no Vulkan device matches " + in_quotation_marks(device) + "; there is ";
    for (std::size_t i = 0; i < reports.size(); ++i)
        message +=
            (i > 0 ? ", " : "") + std::to_string(i) + ' ' + in_quotation_marks(reports[i].name);
    return Error{Status::no_device, std::move(message)};
}

Error none_usable(Reports reports, const std::vector<std::size_t>& matches) {
    std::string message;
    for (const std::size_t match : matches) {
        message += message.empty() ? "" : "; ";
        message += "the device " + std::to_string(match) + ' ' +
                   in_quotation_marks(reports[match].name) + " cannot run geodisk: ";
        const char* separator = "";
        for (const std::string& reason : reports[match].reasons_against) {
            message += separator + reason;
            separator = ", and ";
        }
    }
    return Error{Status::device_lacks, std::move(message)};
}

} // namespace

Result<std::size_t> select_device(std::span<const DeviceReport> reports,
                                  std::string_view device) noexcept {
    return guarded([&]() -> Result<std::size_t> {
        const std::vector<std::size_t> matches = find_matches(reports, device);
        if (matches.empty())
            return nothing_matches(reports, device);
        std::optional<std::size_t> best;
        for (const std::size_t match : matches) {
            if (!reports[match].usable())
                continue;
            if (!best || rank_of(reports[match].type) < rank_of(reports[*best].type))
                best = match;
        }
        if (!best)
            return none_usable(reports, matches);
        return *best;
    });
}

} // namespace geodisk
