#include <algorithm>
#include <cmath>
#include <optional>

#include "files/block_writer.hpp"
#include "files/output_file.hpp"
#include "files/sample_file.hpp"
#include "files/sample_layout.hpp"
#include "files/sample_writers.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

const char* ply_type(std::uint32_t) {
    return "int";
}
const char* ply_type(std::int32_t) {
    return "int";
}
const char* ply_type(std::uint8_t) {
    return "uchar";
}
const char* ply_type(float) {
    return "float";
}
const char* ply_type(double) {
    return "double";
}

void write_ply_header(AtomicFile& file, const SampleHeader& header, std::size_t count, bool ascii,
                      const SampleLayout& layout) {
    file.write(ascii ? "ply\nformat ascii 1.0\n" : "ply\nformat binary_little_endian 1.0\n");
    write_entries(file, header, "comment ");
    file.write("element vertex " + std::to_string(count) + "\n");
    visit_columns({}, 0, layout, [&](std::string_view name, auto value) {
        file.write(std::string("property ") + ply_type(value) + ' ' + std::string(name) + '\n');
    });
    file.write("end_header\n");
}

void write_ply(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               bool ascii, const SampleLayout& layout) {
    write_ply_header(file, header, rows.size(), ascii, layout);
    if (ascii) {
        write_text_rows(file, rows, layout, ' ');
    } else {
        write_binary_rows(file, rows, layout);
    }
}

void write_csv(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleLayout& layout) {
    write_entries(file, header, "# ");
    if (!header.entries.empty()) {
        file.write("# " + std::string(kSampleCount) + ": " + std::to_string(rows.size()) + "\n");
    }
    std::string line;
    visit_columns({}, 0, layout, [&](std::string_view name, auto) {
        line += line.empty() ? "" : ",";
        line += name;
    });
    file.write(line + "\n");
    write_text_rows(file, rows, layout, ',');
}

void write_xyz(AtomicFile& file, std::span<const SampleRow> rows) {
    write_rows(file, rows.size(), [&](std::string& text, std::size_t begin, std::size_t end) {
        for (const SampleRow& row : rows.subspan(begin, end - begin)) {
            for (const double coordinate : std::span(row.position).first(3)) {
                append_number(text, coordinate);
                text += ' ';
            }
            text.back() = '\n';
        }
    });
}

/// Whether the header is one of comments, which may be left out.
bool has_comments(SampleFormat format) {
    return format == SampleFormat::ply || format == SampleFormat::csv ||
           format == SampleFormat::obj || format == SampleFormat::pcd;
}

/// Rounding of distances, as a part of the minimum distance.
constexpr double kWorthTelling = 1e-6;

/// Formats that viewers read have x y z in any case, those for programs what coordinates there are.
void write(AtomicFile& file, const SampleTarget& target, const SampleHeader& full_header,
           std::span<const SampleRow> rows, const SampleLayout& for_viewers,
           const SampleLayout& exact) {
    const bool has_header = target.has_header || !has_comments(target.format);
    const SampleHeader header = has_header ? full_header : SampleHeader{};
    switch (target.format) {
    case SampleFormat::ply:
        write_ply(file, header, rows, target.is_text, for_viewers);
        break;
    case SampleFormat::csv:
        write_csv(file, header, rows, exact);
        break;
    case SampleFormat::xyz:
        write_xyz(file, rows);
        break;
    case SampleFormat::obj:
        write_obj(file, header, rows, for_viewers);
        break;
    case SampleFormat::pcd:
        write_pcd(file, header, rows, target, for_viewers);
        break;
    case SampleFormat::npz:
        write_npz(file, header, rows, exact);
        break;
    case SampleFormat::gltf:
    case SampleFormat::glb:
#ifdef GEODISK_GLTF
        write_gltf(file, header, rows, target, for_viewers);
#endif
        break; // Else sample_target() has refused it.
    case SampleFormat::usda:
        write_usd(file, header, rows, target, for_viewers);
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
    const bool has_radius = has_radii(rows), has_polygon = has_polygons(rows);
    SampleLayout for_viewers{dimension,
                             dimension >= 3 ? 3u : 0u,
                             float_is_enough(rows, dimension),
                             has_radius,
                             has_polygon,
                             true,
                             further};
    for_viewers.has_byte_colours = target.format == SampleFormat::ply;
    const SampleLayout exact{
        dimension, dimension == 3 ? 3u : 0u, false, has_radius, has_polygon, true, further};
    write(file, target, header, rows, for_viewers, exact);
}

void write_box_samples(AtomicFile& file, const SampleTarget& target, const SampleHeader& header,
                       std::span<const SampleRow> rows, std::uint32_t dimension) {
    const SampleLayout for_viewers{dimension, 3, false, false, false, false};
    const SampleLayout exact{dimension, dimension > 3 ? 0 : dimension, false, false, false, false};
    write(file, target, header, rows, for_viewers, exact);
}

std::optional<std::string> precision_note(const SampleTarget& target,
                                          std::span<const SampleRow> rows,
                                          std::uint32_t dimension) {
    if (target.format != SampleFormat::pcd || float_is_enough(rows, std::min(dimension, 3u))) {
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
    const bool has_floats =
        target.format == SampleFormat::pcd || target.format == SampleFormat::gltf ||
        target.format == SampleFormat::glb || target.format == SampleFormat::usda;
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
