#include <algorithm>
#include <cmath>
#include <optional>

#include "files/output/output_file.hpp"
#include "files/samples/sample_file.hpp"
#include "files/samples/sample_layout.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Rounding of distances, as a part of the minimum distance.
constexpr double kWorthTelling = 1e-6;

} // namespace

void write_samples(const Path& path, const SampleHeader& header, std::span<const SampleRow> rows,
                   bool is_text, std::uint32_t dimension) {
    const SampleTarget target = sample_target(path, {}, is_text);
    check_dimension(target, dimension); // Before a file appears.
    AtomicFile file(path);
    write_samples(file, target, header, rows, dimension);
    file.commit();
}

void write_samples(AtomicFile& file, const SampleTarget& target, const SampleHeader& header,
                   std::span<const SampleRow> rows, std::uint32_t dimension,
                   const FurtherColumns& further) {
    const bool is_float_enough = float_is_enough(SampleBox(rows), dimension);
    SampleLayout layout = layout_in(target.format, dimension, is_float_enough);
    layout.has_radius = has_radii(rows);
    layout.has_polygon = has_polygons(rows);
    layout.further = further;
    facts_of(target.format).write(file, header, rows, target, layout);
}

void write_box_samples(AtomicFile& file, const SampleTarget& target, const SampleHeader& header,
                       std::span<const SampleRow> rows, std::uint32_t dimension) {
    const std::uint32_t there_are = dimension > 3 ? 0 : dimension;
    const std::uint32_t named = facts_of(target.format).is_for_programs ? there_are : 3;
    facts_of(target.format)
        .write(file, header, rows, target, {dimension, named, false, false, false, false});
}

std::optional<std::string> precision_note(const SampleTarget& target,
                                          std::span<const SampleRow> rows,
                                          std::uint32_t dimension) {
    if (target.format != SampleFormat::pcd ||
        float_is_enough(SampleBox(rows), std::min(dimension, 3u))) {
        return std::nullopt;
    }
    std::string text = "programs read x y z of PCD as floats, which would blur these: they are "
                       "written relative to the point";
    for (const double coordinate : middle_of(rows)) {
        text += ' ' + exact_text(coordinate);
    }
    return text + (target.has_header ? ", which the header names as origin; " : "; ") +
           listed_formats(&FormatFacts::holds_all, ".", " and ") + " hold them as they are";
}

std::optional<std::string> rounding_note(const SampleTarget& target,
                                         std::span<const SampleRow> rows, std::uint32_t dimension,
                                         double min_distance) {
    double largest = 0;
    for (const SampleRow& row : rows) {
        for (const double coordinate : std::span(row.position).first(dimension)) {
            largest = std::max(largest, std::abs(coordinate));
        }
    }
    // Both ends of a distance may be off by half a step along each axis.
    const double error = std::sqrt(dimension) * largest * 0x1p-23 / min_distance;
    if (!facts_of(target.format).has_floats || error < kWorthTelling) {
        return std::nullopt;
    }
    return extension_of(target.format) + " holds floats, which change distances by up to " +
           rounded(error, 2) +
           " of the minimum distance, so that verify may find some too small; " +
           listed_formats(&FormatFacts::holds_all, ".", " and ") + " hold doubles";
}

void fail_same_name(const SampleTarget& target, const std::string& name) {
    fail_usage(target.path.string() + ": two columns would be called " + in_quotes(name) +
               "; leave one out, or use " + listed_formats(&FormatFacts::holds_all));
}

const std::string* SampleHeader::find(std::string_view key) const {
    const auto entry = std::find_if(entries.begin(), entries.end(),
                                    [key](const auto& one) { return one.first == key; });
    return entry == entries.end() ? nullptr : &entry->second;
}

std::span<const std::uint32_t> SampleFile::extra_values(std::string_view name) const {
    const auto column = std::ranges::find(extra, name, &ExtraColumn::name);
    return column == extra.end() ? std::span<const std::uint32_t>() : column->values;
}

void check_dimension(const SampleTarget& target, std::uint32_t dimension) {
    const FormatFacts& format = facts_of(target.format);
    if (dimension < format.min_dimension || dimension > format.max_dimension) {
        fail_usage(target.path.string() + ": " + a_file(target.format) + " holds " +
                   (format.max_dimension == 3 ? "three " : "") +
                   "coordinates, and these samples have " +
                   (dimension == 0 ? "none" : std::to_string(dimension)) + "; use " +
                   listed_formats(&FormatFacts::holds_all));
    }
}

void check_columns(const SampleTarget& target, std::span<const std::string> columns) {
    const SampleContent content = facts_of(target.format).content;
    if (content != SampleContent::columns && !columns.empty()) {
        fail_usage(target.path.string() + ": " + a_file(target.format) + " holds points" +
                   (content == SampleContent::normals ? " and normals" : "") +
                   " alone, so no column " + columns.front() + "; use " +
                   listed_formats(&FormatFacts::has_columns));
    }
}

void check_box_dimension(const SampleTarget& target, std::uint32_t dimension) {
    if (dimension > 3) {
        check_dimension(target, dimension);
    }
}

} // namespace geodisk::tools
