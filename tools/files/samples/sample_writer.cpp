#include <algorithm>
#include <cmath>
#include <optional>

#include "files/output/block_writer.hpp"
#include "files/output/output_file.hpp"
#include "files/samples/row_format.hpp"
#include "files/samples/sample_file.hpp"
#include "files/samples/sample_layout.hpp"
#include "files/samples/sample_writers.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

void write_by_row(AtomicFile& file, const RowFormat& format, const SampleHeader& header,
                  std::span<const SampleRow> rows) {
    file.write(format.head(header, rows.size()));
    write_rows(file, rows.size(), [&](std::string& bytes, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            format.append(bytes, rows[i], i);
        }
    });
}

/// Returns true if the header consists of comments, which may be left out.
bool has_comments(SampleFormat format) {
    return format == SampleFormat::obj || format == SampleFormat::pcd;
}

/// Rounding of distances, as a part of the minimum distance.
constexpr double kWorthTelling = 1e-6;

void write(AtomicFile& file, const SampleTarget& target, const SampleHeader& full_header,
           std::span<const SampleRow> rows, const SampleLayout& layout) {
    const bool has_header = target.has_header || !has_comments(target.format);
    const SampleHeader header = has_header ? full_header : SampleHeader{};
    switch (target.format) {
    case SampleFormat::ply:
    case SampleFormat::csv:
    case SampleFormat::xyz:
        write_by_row(file, RowFormat(target, layout), full_header, rows);
        break;
    case SampleFormat::obj:
        write_obj(file, header, rows, layout);
        break;
    case SampleFormat::pcd:
        write_pcd(file, header, rows, target, layout);
        break;
    case SampleFormat::npz:
        write_npz(file, header, rows, layout);
        break;
    case SampleFormat::gltf:
    case SampleFormat::glb:
        write_gltf(file, header, rows, target, layout);
        break;
    case SampleFormat::usda:
        write_usd(file, header, rows, target, layout);
        break;
    }
}

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
    write(file, target, header, rows, layout);
}

void write_box_samples(AtomicFile& file, const SampleTarget& target, const SampleHeader& header,
                       std::span<const SampleRow> rows, std::uint32_t dimension) {
    const std::uint32_t there_are = dimension > 3 ? 0 : dimension;
    const std::uint32_t named = is_for_programs(target.format) ? there_are : 3;
    write(file, target, header, rows, {dimension, named, false, false, false, false});
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
           ".ply, .csv and .npz hold them as they are";
}

std::optional<std::string> rounding_note(const SampleTarget& target,
                                         std::span<const SampleRow> rows, std::uint32_t dimension,
                                         double min_distance) {
    const bool has_floats = target.format == SampleFormat::pcd || is_scene(target.format);
    double largest = 0;
    for (const SampleRow& row : rows) {
        for (const double coordinate : std::span(row.position).first(dimension)) {
            largest = std::max(largest, std::abs(coordinate));
        }
    }
    // Both ends of a distance may be off by half a step along each axis.
    const double error = std::sqrt(dimension) * largest * 0x1p-23 / min_distance;
    if (!has_floats || error < kWorthTelling) {
        return std::nullopt;
    }
    return extension_of(target.format) + " holds floats, which change distances by up to " +
           rounded(error, 2) +
           " of the minimum distance, so that verify may find some too small; .ply, .csv and .npz "
           "hold doubles";
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
    const std::string extension = extension_of(target.format);
    const std::string given = dimension == 0 ? "none" : std::to_string(dimension);
    switch (target.format) {
    case SampleFormat::xyz:
    case SampleFormat::obj:
    case SampleFormat::gltf:
    case SampleFormat::glb:
    case SampleFormat::usda:
        if (dimension != 3) {
            const bool has_an = extension == ".obj" || extension == ".xyz";
            fail_usage(target.path.string() + ": " + (has_an ? "an " : "a ") + extension +
                       " file holds three coordinates, and these samples have " + given +
                       "; use .ply, .csv or .npz");
        }
        break;
    case SampleFormat::pcd:
        if (dimension == 0) {
            fail_usage(target.path.string() +
                       ": a .pcd file holds coordinates, and these samples have none; use .ply, "
                       ".csv or .npz");
        }
        break;
    case SampleFormat::ply:
    case SampleFormat::csv:
    case SampleFormat::npz:
        break;
    }
}

bool has_columns(const SampleTarget& target) {
    return target.format != SampleFormat::xyz && target.format != SampleFormat::obj;
}

void check_columns(const SampleTarget& target, std::span<const std::string> columns) {
    if (!has_columns(target) && !columns.empty()) {
        fail_usage(
            target.path.string() + ": an " + extension_of(target.format) + " file holds points" +
            (target.format == SampleFormat::obj ? " and normals" : "") + " alone, so no column " +
            columns.front() + "; use .ply, .csv, .npz, .pcd, .glb, .gltf or .usda");
    }
}

void check_box_dimension(const SampleTarget& target, std::uint32_t dimension) {
    if (dimension > 3) {
        check_dimension(target, dimension);
    }
}

} // namespace geodisk::tools
