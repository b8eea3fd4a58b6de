
#include "files/ply_file.hpp"
#include "files/sample_writers.hpp"
#include "files/zip_writer.hpp"
#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

/// A .npy file of version 1.0 without its content: `type` and `shape` as numpy writes them, "<f8"
/// and "(2, 3)".
std::string array_header(const std::string& type, const std::string& shape) {
    std::string text =
        "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }";
    constexpr std::size_t kBefore = 10, kAlignment = 64;
    text.append(kAlignment - (kBefore + text.size() + 1) % kAlignment, ' ');
    text += '\n';
    std::string header("\x93NUMPY\x01\x00", 8);
    append_little_endian(header, static_cast<std::uint16_t>(text.size()));
    return header + text;
}

std::string column_shape(std::size_t rows) {
    return '(' + std::to_string(rows) + ",)";
}

std::string table_shape(std::size_t rows, std::size_t columns) {
    return '(' + std::to_string(rows) + ", " + std::to_string(columns) + ')';
}

/// Adds an array whose content `append(bytes, row)` appends for each row.
template <class Append>
void add_array(ZipWriter& zip, const std::string& name, const std::string& type,
               const std::string& shape, std::span<const SampleRow> rows, const Append& append) {
    std::string bytes = array_header(type, shape);
    for (const SampleRow& row : rows) {
        append(bytes, row);
    }
    zip.add(name + ".npy", bytes);
}

template <class Value>
void add_scalar(ZipWriter& zip, const std::string& name, const std::string& type, Value value) {
    std::string bytes = array_header(type, "()");
    append_little_endian(bytes, value);
    zip.add(name + ".npy", bytes);
}

/// Numpy has text as characters of four bytes; `text` must be ASCII.
void add_text(ZipWriter& zip, const std::string& name, std::string_view text) {
    std::string bytes = array_header("<U" + std::to_string(text.size()), "()");
    for (const char c : text) {
        append_little_endian(bytes, static_cast<std::uint32_t>(c));
    }
    zip.add(name + ".npy", bytes);
}

void append_double(std::string& bytes, double value) {
    append_little_endian(bytes, value);
}

void add_surface_arrays(ZipWriter& zip, std::span<const SampleRow> rows,
                        const SampleLayout& layout) {
    const std::string triples = table_shape(rows.size(), 3), numbers = column_shape(rows.size());
    if (layout.has_normals()) {
        add_array(zip, "normals", "<f8", triples, rows, [](std::string& bytes, const auto& row) {
            for (const float value : row.normal) {
                append_double(bytes, static_cast<double>(value));
            }
        });
    }
    add_array(zip, "face_index", "<u4", numbers, rows,
              [](std::string& bytes, const auto& row) { append_little_endian(bytes, row.face); });
    add_array(zip, "barycentric", "<f8", triples, rows, [](std::string& bytes, const auto& row) {
        for (const float value : row.bary) {
            append_double(bytes, static_cast<double>(value));
        }
    });
    if (layout.has_radius) {
        add_array(zip, "radius", "<f8", numbers, rows,
                  [](std::string& bytes, const auto& row) { append_double(bytes, row.radius); });
    }
    for (const ExtraColumn& column : layout.extra) {
        std::string bytes = array_header("<u4", numbers);
        for (const std::uint32_t value : column.values) {
            append_little_endian(bytes, value);
        }
        zip.add(column.name + ".npy", bytes);
    }
    if (layout.has_polygon) {
        add_array(zip, "polygon_index", "<u4", numbers, rows,
                  [](std::string& bytes, const auto& row) {
                      append_little_endian(bytes, row.polygon.value_or(0));
                  });
    }
}

} // namespace

void write_npz(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleLayout& layout) {
    ZipWriter zip(file);
    if (layout.dimension > 0) {
        add_array(zip, "points", "<f8", table_shape(rows.size(), layout.dimension), rows,
                  [&](std::string& bytes, const auto& row) {
                      for (std::uint32_t axis = 0; axis < layout.dimension; ++axis) {
                          append_double(bytes, row.position[axis]);
                      }
                  });
    }
    if (layout.is_on_surface) {
        add_surface_arrays(zip, rows, layout);
    }
    if (const std::string* const text = header.find("min_distance")) {
        if (const auto distance = parse_real(*text)) {
            add_scalar(zip, "min_distance", "<f8", *distance);
        }
    }
    if (const std::string* const text = header.find("seed")) {
        if (const auto seed = parse_integer<std::uint64_t>(*text)) {
            add_scalar(zip, "seed", "<u8", *seed);
        }
    }
    add_text(zip, "header", json_text(header));
    zip.finish();
}

} // namespace geodisk::tools
