#include "files/samples/sample_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

bool is_coordinate(SampleColumn column) {
    return column <= SampleColumn::z;
}

bool is_of_face(SampleColumn column) {
    return column >= SampleColumn::face_index && column <= SampleColumn::bary_w;
}

/// x0 x1 ... as far as they go; `place_of(name)` is where the column of that name stands, if the
/// file has it.
void find_numbered(const Path& path, const PlaceOf& place_of, ColumnPlaces& places) {
    for (const std::string_view name : kNumberedColumnNames) {
        const std::optional<std::size_t> place = place_of(name);
        if (!place) {
            break;
        }
        places.coordinates.push_back(*place);
    }
    places.is_numbered = !places.coordinates.empty();
    if (places.is_numbered && places.coordinates.size() < 3) {
        fail_input(path,
                   "has no column " + std::string(kNumberedColumnNames[places.coordinates.size()]));
    }
}

/// x y z: on a surface all or none, in a box the first ones, as many as it has.
void find_named(const Path& path, SampleDomain domain, const PlaceOf& place_of,
                ColumnPlaces& places) {
    std::string_view missing;
    for (const SampleColumn column : {SampleColumn::x, SampleColumn::y, SampleColumn::z}) {
        const std::string_view name = kSampleColumnNames[static_cast<std::size_t>(column)];
        const std::optional<std::size_t> found = place_of(name);
        if (found && missing.empty()) {
            places.coordinates.push_back(*found);
        } else if (found) {
            fail_input(path, "has no column " + std::string(missing));
        } else if (missing.empty()) {
            missing = name;
        }
    }
    const bool is_short = domain == SampleDomain::box
                              ? places.coordinates.empty()
                              : !places.coordinates.empty() && !missing.empty();
    if (is_short) {
        fail_input(path, "has no column " + std::string(missing));
    }
}

} // namespace

bool set_index(std::uint32_t& index, double value) {
    if (!(value >= 0 && value <= std::numeric_limits<std::uint32_t>::max())) {
        return false;
    }
    index = static_cast<std::uint32_t>(value);
    return static_cast<double>(index) == value;
}

ColumnPlaces find_places(const Path& path, SampleDomain domain, const PlaceOf& place_of) {
    ColumnPlaces places;
    find_numbered(path, place_of, places);
    std::size_t faces = 0, wanted = 0;
    std::string_view missing;
    for (std::size_t i = 0; i < kSampleColumnNames.size(); ++i) {
        if (is_coordinate(SampleColumn{i})) {
            continue;
        }
        places.named[i] = place_of(kSampleColumnNames[i]);
        if (is_of_face(SampleColumn{i})) {
            ++wanted;
            faces += places.named[i] ? 1u : 0u;
            missing = places.named[i] || !missing.empty() ? missing : kSampleColumnNames[i];
        }
    }
    if (!places.is_numbered) {
        find_named(path, domain, place_of, places);
    }
    places.has_faces = faces == wanted;
    const bool are_points = faces == 0 && !places.coordinates.empty();
    if (domain == SampleDomain::surface && faces == 0 && !are_points) {
        fail_input(path, "holds no samples: there are no columns x y z, and no column face_index");
    }
    if (domain == SampleDomain::surface && !places.has_faces && !are_points) {
        fail_input(path, "has no column " + std::string(missing));
    }
    return places;
}

bool set_value(SampleRow& row, SampleColumn column, double value) {
    if (column == SampleColumn::face_index) {
        return set_index(row.face, value);
    }
    if (column == SampleColumn::polygon_index) {
        return set_index(row.polygon.emplace(), value);
    }
    if (column == SampleColumn::radius) {
        row.radius = value;
        return value > 0 && std::isfinite(value);
    }
    const bool is_weight = column >= SampleColumn::bary_u;
    const SampleColumn first = is_weight ? SampleColumn::bary_u : SampleColumn::nx;
    const std::size_t i = static_cast<std::size_t>(column) - static_cast<std::size_t>(first);
    (is_weight ? row.bary : row.normal)[i] = static_cast<float>(value);
    return std::isfinite(value);
}

void add_entry(SampleHeader& header, std::string_view comment) {
    if (const std::size_t colon = comment.find(": "); colon != std::string_view::npos) {
        header.entries.emplace_back(comment.substr(0, colon), comment.substr(colon + 2));
    } else if (comment.ends_with(':')) {
        header.entries.emplace_back(comment.substr(0, comment.size() - 1), "");
    }
}

void check_sample_count(const Path& path, SampleFile& samples) {
    auto& entries = samples.header.entries;
    const auto entry = std::ranges::find(entries, kSampleCount, &HeaderEntries::value_type::first);
    if (entry == entries.end()) {
        return;
    }
    if (entry->second != std::to_string(samples.rows.size())) {
        fail_input(path, "has " + counted(samples.rows.size(), "sample", "samples") +
                             ", but its header says " + one_line(entry->second) +
                             "; the file may be cut short");
    }
    entries.erase(entry);
}

void check_last_line(const Path& path, std::string_view text) {
    if (!text.empty() && !text.ends_with('\n') && !text.ends_with('\r')) {
        fail_input(path, "its last line has no line end, so the file may be cut short; write it "
                         "again, or add the line end");
    }
}

} // namespace geodisk::tools
