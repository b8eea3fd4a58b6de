#include <algorithm>
#include <cmath>

#include "files/input_file.hpp"
#include "files/output_file.hpp"
#include "files/ply_file.hpp"
#include "files/sample_columns.hpp"
#include "files/sample_file.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

enum class Format { ply, csv, xyz };

Format format_of(const Path& path) {
    const std::string extension = lower_extension(path);
    if (extension == ".ply") {
        return Format::ply;
    }
    if (extension == ".csv") {
        return Format::csv;
    }
    if (extension == ".xyz") {
        return Format::xyz;
    }
    fail_usage(path.string() + ": unknown sample format; known are .ply, .csv and .xyz");
}

std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text;
}

void write_entries(AtomicFile& file, const SampleHeader& header, const char* prefix) {
    for (const auto& [key, value] : header.entries) {
        file.write(prefix + one_line(key) + ": " + one_line(value) + "\n");
    }
}

/// Whether rounding to float moves no position by more than a millionth of the set's extent.
bool float_is_enough(std::span<const SampleRow> rows, std::uint32_t dimension) {
    double largest = 0;
    double extent = 0;
    for (std::uint32_t axis = 0; axis < dimension && !rows.empty(); ++axis) {
        const auto [low, high] = std::minmax_element(
            rows.begin(), rows.end(), [axis](const SampleRow& a, const SampleRow& b) {
                return a.position[axis] < b.position[axis];
            });
        const double least = low->position[axis], most = high->position[axis];
        largest = std::max({largest, std::abs(least), std::abs(most)});
        extent = std::max(extent, most - least);
    }
    constexpr double kSmallestFloat = 1e-30; // Well above where float loses digits.
    constexpr double kLargestFloat = 1e38;
    const bool in_range = largest == 0 || (largest > kSmallestFloat && largest < kLargestFloat);
    return in_range && largest <= 16 * extent;
}

/// What the columns of a file are.
struct Layout {
    std::uint32_t dimension;
    std::uint32_t named; ///< How many of the first three coordinates by the names x, y and z.
    bool has_float_positions;
    bool has_radius;
    bool has_polygon = false;
    bool is_on_surface = true;

    std::size_t numbered() const { return dimension > 3 ? dimension : 0; }
    bool has_normals() const { return is_on_surface && dimension == 3; }
};

/// Calls visit(name, value) for each column of a row, in order.
template <typename Visit>
void visit_columns(const SampleRow& row, const Layout& layout, const Visit& visit) {
    const auto visit_position = [&](std::span<const std::string_view> names) {
        for (std::size_t axis = 0; axis < names.size(); ++axis) {
            if (layout.has_float_positions) {
                visit(names[axis], static_cast<float>(row.position[axis]));
            } else {
                visit(names[axis], row.position[axis]);
            }
        }
    };
    const auto name_of = [](SampleColumn first, std::size_t offset = 0) {
        return kSampleColumnNames[static_cast<std::size_t>(first) + offset];
    };
    visit_position(std::span(kSampleColumnNames).first(layout.named));
    visit_position(std::span(kNumberedColumnNames).first(layout.numbered()));
    for (std::size_t axis = 0; axis < 3 && layout.has_normals(); ++axis) {
        visit(name_of(SampleColumn::nx, axis), row.normal[axis]);
    }
    if (layout.is_on_surface) {
        visit(name_of(SampleColumn::face_index), row.face);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            visit(name_of(SampleColumn::bary_u, corner), row.bary[corner]);
        }
    }
    if (layout.has_radius) {
        visit(name_of(SampleColumn::radius), row.radius);
    }
    if (layout.has_polygon) {
        visit(name_of(SampleColumn::polygon_index), row.polygon.value_or(0));
    }
}

const char* ply_type(std::uint32_t) {
    return "int";
}
const char* ply_type(float) {
    return "float";
}
const char* ply_type(double) {
    return "double";
}

void write_ply_header(AtomicFile& file, const SampleHeader& header, std::size_t count, bool ascii,
                      const Layout& layout) {
    file.write(ascii ? "ply\nformat ascii 1.0\n" : "ply\nformat binary_little_endian 1.0\n");
    write_entries(file, header, "comment ");
    file.write("element vertex " + std::to_string(count) + "\n");
    visit_columns({}, layout, [&](std::string_view name, auto value) {
        file.write(std::string("property ") + ply_type(value) + ' ' + std::string(name) + '\n');
    });
    file.write("end_header\n");
}

void append_text_row(std::string& line, const SampleRow& row, const Layout& layout,
                     char separator) {
    visit_columns(row, layout, [&](std::string_view, auto value) {
        append_number(line, value);
        line += separator;
    });
    line.back() = '\n';
}

void write_ply(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               bool ascii, const Layout& layout) {
    write_ply_header(file, header, rows.size(), ascii, layout);
    std::string record;
    for (const SampleRow& row : rows) {
        record.clear();
        if (ascii) {
            append_text_row(record, row, layout, ' ');
        } else {
            visit_columns(row, layout, [&](std::string_view, auto value) {
                append_little_endian(record, value);
            });
        }
        file.write(record);
    }
}

void write_csv(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const Layout& layout) {
    write_entries(file, header, "# ");
    std::string line;
    visit_columns({}, layout, [&](std::string_view name, auto) {
        line += line.empty() ? "" : ",";
        line += name;
    });
    file.write(line + "\n");
    for (const SampleRow& row : rows) {
        line.clear();
        append_text_row(line, row, layout, ',');
        file.write(line);
    }
}

void write_xyz(AtomicFile& file, std::span<const SampleRow> rows) {
    std::string line;
    for (const SampleRow& row : rows) {
        line.clear();
        for (const double coordinate : std::span(row.position).first(3)) {
            append_number(line, coordinate);
            line += ' ';
        }
        line.back() = '\n';
        file.write(line);
    }
}

} // namespace

void write_samples(const Path& path, const SampleHeader& header, std::span<const SampleRow> rows,
                   bool ascii_ply, std::uint32_t dimension) {
    check_dimension(path, dimension); // Before a file appears.
    AtomicFile file(path);
    write_samples(file, path, header, rows, ascii_ply, dimension);
    file.commit();
}

void write_samples(AtomicFile& file, const Path& path, const SampleHeader& header,
                   std::span<const SampleRow> rows, bool ascii_ply, std::uint32_t dimension) {
    switch (format_of(path)) {
    case Format::ply:
        write_ply(file, header, rows, ascii_ply,
                  {dimension, dimension >= 3 ? 3u : 0u, float_is_enough(rows, dimension),
                   has_radii(rows), has_polygons(rows)});
        break;
    case Format::csv:
        write_csv(
            file, header, rows,
            {dimension, dimension == 3 ? 3u : 0u, false, has_radii(rows), has_polygons(rows)});
        break;
    case Format::xyz:
        write_xyz(file, rows);
        break;
    }
}

void write_box_samples(AtomicFile& file, const Path& path, const SampleHeader& header,
                       std::span<const SampleRow> rows, bool ascii_ply, std::uint32_t dimension) {
    switch (format_of(path)) {
    case Format::ply:
        write_ply(file, header, rows, ascii_ply, {dimension, 3, false, false, false, false});
        break;
    case Format::csv:
        write_csv(file, header, rows,
                  {dimension, dimension > 3 ? 0 : dimension, false, false, false, false});
        break;
    case Format::xyz:
        write_xyz(file, rows);
        break;
    }
}

const std::string* SampleHeader::find(std::string_view key) const {
    const auto entry = std::find_if(entries.begin(), entries.end(),
                                    [key](const auto& one) { return one.first == key; });
    return entry == entries.end() ? nullptr : &entry->second;
}

void check_output_path(const Path& path) {
    format_of(path);
    const AtomicFile probe(path); // Creates and removes the temporary file.
}

void check_dimension(const Path& path, std::uint32_t dimension) {
    if (format_of(path) == Format::xyz && dimension != 3) {
        fail_usage(path.string() +
                   ": an .xyz file holds three coordinates, and these samples "
                   "have " +
                   (dimension == 0 ? "none" : std::to_string(dimension)) + "; use .ply or .csv");
    }
}

void check_box_dimension(const Path& path, std::uint32_t dimension) {
    if (dimension > 3) {
        check_dimension(path, dimension);
    }
}

} // namespace geodisk::tools
