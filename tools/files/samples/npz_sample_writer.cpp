#include <algorithm>

#include <geodisk/detail/uninitialized.hpp>

#include "files/archives/npz_arrays.hpp"
#include "files/archives/zip_writer.hpp"
#include "files/byte_order.hpp"
#include "files/output/block_writer.hpp"
#include "files/samples/sample_writers.hpp"
#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

std::string column_shape(std::size_t rows) {
    return '(' + std::to_string(rows) + ",)";
}

std::string table_shape(std::size_t rows, std::size_t columns) {
    return '(' + std::to_string(rows) + ", " + std::to_string(columns) + ')';
}

/// Adds arrays of a value for each row, or of several.
class Arrays {
  public:
    Arrays(ZipWriter& zip, std::size_t rows) : zip_(zip), rows_(rows) {}

    /// Adds a column of numbers: `value_of(i)` is that of row i.
    template <class ValueOf>
    void add(const std::string& name, const std::string& type, const ValueOf& value_of) {
        add(name, type, column_shape(rows_), 1,
            [&](std::size_t i, std::size_t) { return value_of(i); });
    }
    /// Adds a table of doubles: `value_of(i, k)` is that of row i and column k.
    template <class ValueOf>
    void add_table(const std::string& name, std::size_t columns, const ValueOf& value_of) {
        add(name, "<f8", table_shape(rows_, columns), columns,
            [&](std::size_t i, std::size_t k) { return static_cast<double>(value_of(i, k)); });
    }

  private:
    template <class ValueOf>
    void add(const std::string& name, const std::string& type, const std::string& shape,
             std::size_t columns, const ValueOf& value_of) {
        const std::string header = array_header(type, shape);
        const std::size_t size = sizeof(value_of(0, 0));
        bytes_.resize(header.size() + rows_ * columns * size);
        std::ranges::copy(header, bytes_.begin());
        for_rows(rows_, [&](std::size_t i) {
            char* out = bytes_.data() + header.size() + i * columns * size;
            for (std::size_t k = 0; k < columns; ++k, out += size) {
                store_little_endian(out, value_of(i, k));
            }
        });
        zip_.add(name + ".npy", {bytes_.data(), bytes_.size()});
    }

    ZipWriter& zip_;
    std::size_t rows_;
    UninitializedVector<char> bytes_; ///< Bytes of the array being added.
};

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

void add_surface_arrays(ZipWriter& zip, Arrays& arrays, std::span<const SampleRow> rows,
                        const SampleLayout& layout) {
    if (layout.has_normals()) {
        arrays.add_table("normals", 3,
                         [&](std::size_t i, std::size_t k) { return rows[i].normal[k]; });
    }
    arrays.add("face_index", "<u4", [&](std::size_t i) { return rows[i].face; });
    arrays.add_table("barycentric", 3,
                     [&](std::size_t i, std::size_t k) { return rows[i].bary[k]; });
    if (layout.has_radius) {
        arrays.add("radius", "<f8", [&](std::size_t i) { return rows[i].radius; });
    }
    for (const ExtraColumn& column : layout.further.numbers) {
        arrays.add(column.name, "<u4", [&](std::size_t i) { return column.values[i]; });
    }
    if (layout.has_polygon) {
        arrays.add("polygon_index", "<u4",
                   [&](std::size_t i) { return rows[i].polygon.value_or(0); });
    }
    for (const SampleField& field : layout.further.fields) {
        add_field(zip, field);
    }
}

} // namespace

void add_field(ZipWriter& zip, const SampleField& field) {
    const std::size_t size = field.components.size();
    if (field.is_whole) {
        const std::vector<std::int32_t> values(field.values.begin(), field.values.end());
        add_array<std::int32_t>(zip, field.name, "<i4", values, size);
    } else {
        add_array<double>(zip, field.name, "<f8", field.values, size);
    }
}

void write_npz(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleTarget& /*target*/, const SampleLayout& layout) {
    ZipWriter zip(file);
    Arrays arrays(zip, rows.size());
    if (layout.dimension > 0) {
        arrays.add_table("points", layout.dimension,
                         [&](std::size_t i, std::size_t k) { return rows[i].position[k]; });
    }
    if (layout.is_on_surface) {
        add_surface_arrays(zip, arrays, rows, layout);
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
