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

Format format_of(const std::filesystem::path& path) {
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
    bool is_on_surface = true;

    bool has_numbered() const { return dimension > 3; }
    bool has_normals() const { return is_on_surface && dimension == 3; }
};

struct Column {
    std::string_view name;
    const char* ply_type;
};

/// In the order of for_each_value().
std::vector<Column> columns_of(const Layout& layout) {
    std::vector<Column> columns;
    const auto add = [&](SampleColumn first, SampleColumn last, const char* type) {
        for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i) {
            columns.push_back({kSampleColumnNames[i], type});
        }
    };
    const char* const coordinate = layout.has_float_positions ? "float" : "double";
    for (std::size_t axis = 0; axis < layout.named; ++axis) {
        columns.push_back({kSampleColumnNames[axis], coordinate});
    }
    for (std::size_t axis = 0; axis < layout.dimension && layout.has_numbered(); ++axis) {
        columns.push_back({kNumberedColumnNames[axis], coordinate});
    }
    if (layout.has_normals()) {
        add(SampleColumn::nx, SampleColumn::nz, "float");
    }
    if (layout.is_on_surface) {
        add(SampleColumn::face_index, SampleColumn::face_index, "int");
        add(SampleColumn::bary_u, SampleColumn::bary_w, "float");
    }
    if (layout.has_radius) {
        add(SampleColumn::radius, SampleColumn::radius, "double");
    }
    return columns;
}

void write_ply_header(AtomicFile& file, const SampleHeader& header, std::size_t count, bool ascii,
                      const Layout& layout) {
    file.write(ascii ? "ply\nformat ascii 1.0\n" : "ply\nformat binary_little_endian 1.0\n");
    write_entries(file, header, "comment ");
    file.write("element vertex " + std::to_string(count) + "\n");
    for (const Column& column : columns_of(layout)) {
        file.write("property ");
        file.write(column.ply_type);
        file.write(" ");
        file.write(column.name);
        file.write("\n");
    }
    file.write("end_header\n");
}

/// Calls append(value) with every value of the row in the order of columns_of().
template <typename Append>
void for_each_value(const SampleRow& row, const Layout& layout, const Append& append) {
    const auto append_coordinates = [&](std::size_t count) {
        for (const double coordinate : std::span(row.position).first(count)) {
            if (layout.has_float_positions) {
                append(static_cast<float>(coordinate));
            } else {
                append(coordinate);
            }
        }
    };
    append_coordinates(layout.named);
    if (layout.has_numbered()) {
        append_coordinates(layout.dimension);
    }
    if (layout.has_normals()) {
        for (const float coordinate : row.normal) {
            append(coordinate);
        }
    }
    if (layout.is_on_surface) {
        append(row.face);
        for (const float weight : row.bary) {
            append(weight);
        }
    }
    if (layout.has_radius) {
        append(row.radius);
    }
}

void append_text_row(std::string& line, const SampleRow& row, const Layout& layout,
                     char separator) {
    for_each_value(row, layout, [&](auto value) {
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
            for_each_value(row, layout, [&](auto value) { append_little_endian(record, value); });
        }
        file.write(record);
    }
}

void write_csv(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const Layout& layout) {
    write_entries(file, header, "# ");
    std::string line;
    for (const Column& column : columns_of(layout)) {
        line += line.empty() ? "" : ",";
        line += column.name;
    }
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

void write_samples(const std::filesystem::path& path, const SampleHeader& header,
                   std::span<const SampleRow> rows, bool ascii_ply, std::uint32_t dimension) {
    check_dimension(path, dimension); // Before a file appears.
    AtomicFile file(path);
    write_samples(file, path, header, rows, ascii_ply, dimension);
    file.commit();
}

void write_samples(AtomicFile& file, const std::filesystem::path& path, const SampleHeader& header,
                   std::span<const SampleRow> rows, bool ascii_ply, std::uint32_t dimension) {
    switch (format_of(path)) {
    case Format::ply:
        write_ply(file, header, rows, ascii_ply,
                  {dimension, dimension >= 3 ? 3u : 0u, float_is_enough(rows, dimension),
                   has_radii(rows)});
        break;
    case Format::csv:
        write_csv(file, header, rows,
                  {dimension, dimension == 3 ? 3u : 0u, false, has_radii(rows)});
        break;
    case Format::xyz:
        write_xyz(file, rows);
        break;
    }
}

void write_box_samples(AtomicFile& file, const std::filesystem::path& path,
                       const SampleHeader& header, std::span<const SampleRow> rows, bool ascii_ply,
                       std::uint32_t dimension) {
    switch (format_of(path)) {
    case Format::ply:
        write_ply(file, header, rows, ascii_ply, {dimension, 3, false, false, false});
        break;
    case Format::csv:
        write_csv(file, header, rows,
                  {dimension, dimension > 3 ? 0 : dimension, false, false, false});
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

void check_output_path(const std::filesystem::path& path) {
    format_of(path);
    const AtomicFile probe(path); // Creates and removes the temporary file.
}

void check_dimension(const std::filesystem::path& path, std::uint32_t dimension) {
    if (format_of(path) == Format::xyz && dimension != 3) {
        fail_usage(path.string() +
                   ": an .xyz file holds three coordinates, and these samples "
                   "have " +
                   (dimension == 0 ? "none" : std::to_string(dimension)) + "; use .ply or .csv");
    }
}

void check_box_dimension(const std::filesystem::path& path, std::uint32_t dimension) {
    if (dimension > 3) {
        check_dimension(path, dimension);
    }
}

} // namespace geodisk::tools
