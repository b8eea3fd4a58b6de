#include "common/sample_file.hpp"

#include "common/atomic_file.hpp"
#include "common/file_input.hpp"
#include "common/sample_columns.hpp"
#include "common/text.hpp"
#include "common/user_error.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

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
    throw UserError(ExitCode::usage,
                    path.string() + ": unknown sample format; known are .ply, .csv and .xyz");
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
bool float_is_enough(std::span<const SampleRow> rows) {
    double largest = 0;
    double extent = 0;
    for (int axis = 0; axis < 3 && !rows.empty(); ++axis) {
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

void write_ply_header(AtomicFile& file, const SampleHeader& header, std::size_t count, bool ascii,
                      bool float_positions) {
    file.write(ascii ? "ply\nformat ascii 1.0\n" : "ply\nformat binary_little_endian 1.0\n");
    write_entries(file, header, "comment ");
    file.write("element vertex " + std::to_string(count) + "\n");
    for (std::size_t i = 0; i < kSampleColumnNames.size(); ++i) {
        const SampleColumn column{i};
        const char* type = "float ";
        if (column <= SampleColumn::z && !float_positions) {
            type = "double ";
        } else if (column == SampleColumn::face_index) {
            type = "int ";
        } else if (column == SampleColumn::candidate) {
            type = "uint ";
        }
        file.write("property ");
        file.write(type);
        file.write(kSampleColumnNames[i]);
        file.write("\n");
    }
    file.write("end_header\n");
}

template <typename Value>
void append_little_endian(std::string& bytes, Value value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if constexpr (std::endian::native == std::endian::big) {
        std::reverse(raw, raw + sizeof raw);
    }
    bytes.append(raw, sizeof raw);
}

/// Calls append(value) with every value of the row in the order of kSampleColumnNames.
template <typename Append>
void for_each_value(const SampleRow& row, bool float_positions, const Append& append) {
    for (const double coordinate : row.position) {
        if (float_positions) {
            append(static_cast<float>(coordinate));
        } else {
            append(coordinate);
        }
    }
    for (const float coordinate : row.normal) {
        append(coordinate);
    }
    append(row.face);
    for (const float weight : row.bary) {
        append(weight);
    }
    append(row.candidate);
}

void append_text_row(std::string& line, const SampleRow& row, bool float_positions,
                     char separator) {
    for_each_value(row, float_positions, [&](auto value) {
        append_number(line, value);
        line += separator;
    });
    line.back() = '\n';
}

void write_ply(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               bool ascii) {
    const bool float_positions = float_is_enough(rows);
    write_ply_header(file, header, rows.size(), ascii, float_positions);
    std::string record;
    for (const SampleRow& row : rows) {
        record.clear();
        if (ascii) {
            append_text_row(record, row, float_positions, ' ');
        } else {
            for_each_value(row, float_positions,
                           [&](auto value) { append_little_endian(record, value); });
        }
        file.write(record);
    }
}

void write_csv(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows) {
    write_entries(file, header, "# ");
    std::string line;
    for (const std::string_view name : kSampleColumnNames) {
        line += line.empty() ? "" : ",";
        line += name;
    }
    file.write(line + "\n");
    for (const SampleRow& row : rows) {
        line.clear();
        append_text_row(line, row, false, ',');
        file.write(line);
    }
}

void write_xyz(AtomicFile& file, std::span<const SampleRow> rows) {
    std::string line;
    for (const SampleRow& row : rows) {
        line.clear();
        for (const double coordinate : row.position) {
            append_number(line, coordinate);
            line += ' ';
        }
        line.back() = '\n';
        file.write(line);
    }
}

} // namespace

void write_samples(const std::filesystem::path& path, const SampleHeader& header,
                   std::span<const SampleRow> rows, bool ascii_ply) {
    format_of(path); // Before a file appears.
    AtomicFile file(path);
    write_samples(file, path, header, rows, ascii_ply);
    file.commit();
}

void write_samples(AtomicFile& file, const std::filesystem::path& path, const SampleHeader& header,
                   std::span<const SampleRow> rows, bool ascii_ply) {
    switch (format_of(path)) {
    case Format::ply:
        write_ply(file, header, rows, ascii_ply);
        break;
    case Format::csv:
        write_csv(file, header, rows);
        break;
    case Format::xyz:
        write_xyz(file, rows);
        break;
    }
}

void check_output_path(const std::filesystem::path& path) {
    format_of(path);
    const AtomicFile probe(path); // Creates and removes the temporary file.
}

} // namespace geodisk::tools
