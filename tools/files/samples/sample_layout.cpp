#include "files/samples/sample_layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "files/ply_file.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/safe_text.hpp"

namespace geodisk::tools {
namespace {

constexpr double kSmallestFloat = 1e-30; // Well above where float loses digits.

} // namespace

SampleBox::SampleBox() {
    std::ranges::fill(least, std::numeric_limits<double>::infinity());
    std::ranges::fill(most, -std::numeric_limits<double>::infinity());
}

SampleBox::SampleBox(std::span<const SampleRow> rows) : SampleBox() {
    for (const SampleRow& row : rows) {
        for (std::size_t axis = 0; axis < std::size(least); ++axis) {
            least[axis] = std::min(least[axis], row.position[axis]);
            most[axis] = std::max(most[axis], row.position[axis]);
        }
    }
}

void SampleBox::add(const SampleBox& other) {
    for (std::size_t axis = 0; axis < std::size(least); ++axis) {
        least[axis] = std::min(least[axis], other.least[axis]);
        most[axis] = std::max(most[axis], other.most[axis]);
    }
}

bool float_is_enough(const SampleBox& box, std::uint32_t dimension) {
    double largest = 0;
    double extent = 0;
    for (std::uint32_t axis = 0; axis < dimension && box.least[axis] <= box.most[axis]; ++axis) {
        largest = std::max({largest, std::abs(box.least[axis]), std::abs(box.most[axis])});
        extent = std::max(extent, box.most[axis] - box.least[axis]);
    }
    constexpr double kLargestFloat = 1e38;
    const bool in_range = largest == 0 || (largest > kSmallestFloat && largest < kLargestFloat);
    return in_range && largest <= 16 * extent;
}

SampleLayout layout_in(SampleFormat format, std::uint32_t dimension, bool is_float_enough) {
    const FormatFacts& facts = facts_of(format);
    const bool is_exact = facts.is_for_programs;
    const bool is_named = is_exact ? dimension == 3 : dimension >= 3;
    SampleLayout layout{dimension, is_named ? 3u : 0u, !is_exact && is_float_enough, false};
    layout.colours = facts.colours;
    return layout;
}

std::array<double, 3> middle_of(std::span<const SampleRow> rows) {
    std::array<double, 3> middle{};
    for (std::size_t axis = 0; axis < 3 && !rows.empty(); ++axis) {
        const auto [least, most] = std::ranges::minmax_element(
            rows, {}, [axis](const SampleRow& row) { return row.position[axis]; });
        middle[axis] = least->position[axis] / 2 + most->position[axis] / 2;
    }
    return middle;
}

std::array<double, 3> origin_for_float(std::span<const SampleRow> rows, std::uint32_t dimension) {
    return float_is_enough(SampleBox(rows), std::min(dimension, 3u)) ? std::array<double, 3>{}
                                                                     : middle_of(rows);
}

void check_float_range(const SampleTarget& target, std::span<const SampleRow> rows,
                       const std::array<double, 3>& origin) {
    constexpr double kMax = std::numeric_limits<float>::max();
    double largest = 0, largest_radius = 0;
    for (const SampleRow& row : rows) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            largest = std::max(largest, std::abs(row.position[axis] - origin[axis]));
        }
        largest_radius = std::max(largest_radius, row.radius);
    }
    const auto fits = [](double value) {
        return value == 0 || (value >= kSmallestFloat && value <= kMax);
    };
    if (!fits(largest) || !fits(largest_radius)) {
        fail_usage(target.path.string() + ": " + extension_of(target.format) +
                   " holds floats, and these samples have coordinates up to " +
                   exact_text(largest) + "; use " + listed_formats(&FormatFacts::holds_all));
    }
}

std::string entry_lines(const SampleHeader& header, const SampleTarget& target,
                        const char* prefix) {
    std::string lines;
    if (!target.has_header) {
        return lines;
    }
    for (const auto& [key, value] : header.entries) {
        std::string entry = key + ": ";
        entry += value;
        // Some of these formats end in spreadsheets.
        lines += prefix + csv_comment(entry) + '\n';
    }
    return lines;
}

std::string json_text(const SampleHeader& header) {
    nlohmann::ordered_json document = nlohmann::ordered_json::object();
    for (const auto& [key, value] : header.entries) {
        nlohmann::ordered_json& known = document[key];
        if (known.is_null()) {
            known = value;
        } else if (known.is_array()) {
            known.push_back(value);
        } else {
            known = {known, value};
        }
    }
    // Paths and driver names may be anything, also what is not UTF-8.
    return document.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

} // namespace geodisk::tools
