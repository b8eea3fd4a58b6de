#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/byte_order.hpp"
#include "files/output/block_writer.hpp"
#include "files/samples/sample_writers.hpp"
#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

std::string_view vtp_type(std::uint8_t) {
    return "UInt8";
}
std::string_view vtp_type(std::int32_t) {
    return "Int32";
}
std::string_view vtp_type(std::uint32_t) {
    return "UInt32";
}
std::string_view vtp_type(std::int64_t) {
    return "Int64";
}
std::string_view vtp_type(float) {
    return "Float32";
}
std::string_view vtp_type(double) {
    return "Float64";
}

/// Appends a number as text; a byte is no character.
template <typename Value>
void append_text(std::string& text, Value value) {
    if constexpr (sizeof value == 1) {
        append_number(text, static_cast<unsigned>(value));
    } else {
        append_number(text, value);
    }
}

/// Writes the arrays of points: in text inside their elements, or else as bytes behind the XML.
class VtpArrays {
  public:
    VtpArrays(AtomicFile& file, std::size_t rows, bool is_text)
        : file_(file), rows_(rows), is_text_(is_text) {}

    /// Writes an array, or where its bytes will be; `value(i, k)` is component k of row i.
    template <class Value>
    void add(const std::string& name, std::size_t components, const Value& value) {
        using Number = decltype(value(0, 0));
        file_.write("<DataArray type=\"" + std::string(vtp_type(Number{})) + "\" Name=\"" + name +
                    "\" NumberOfComponents=\"" + std::to_string(components) + "\" format=\"");
        const bool is_text = is_text_;
        Append append = [=](std::string& bytes, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                for (std::size_t k = 0; k < components; ++k) {
                    if (is_text) {
                        append_text(bytes, value(i, k));
                        bytes += k + 1 < components ? ' ' : '\n';
                    } else {
                        append_little_endian(bytes, value(i, k));
                    }
                }
            }
        };
        if (is_text_) {
            file_.write("ascii\">\n");
            write_rows(file_, rows_, append);
            file_.write("</DataArray>\n");
            return;
        }
        const std::uint64_t size = rows_ * components * sizeof(Number);
        file_.write("appended\" offset=\"" + std::to_string(offset_) + "\"/>\n");
        offset_ += sizeof size + size;
        appended_.emplace_back(size, std::move(append));
    }

    void add_field(const SampleField& field, ColourEncoding colours) {
        const std::size_t size = field.components.size();
        const auto value = [&field, size](std::size_t i, std::size_t k) {
            return field.values[i * size + k];
        };
        if (field.is_whole) {
            add(field.name, size, [value](std::size_t i, std::size_t k) {
                return static_cast<std::int32_t>(value(i, k));
            });
        } else if (field.is_colour && colours == ColourEncoding::bytes) {
            add(field.name, size,
                [value](std::size_t i, std::size_t k) { return colour_byte(value(i, k)); });
        } else if (field.is_float) {
            add(field.name, size,
                [value](std::size_t i, std::size_t k) { return static_cast<float>(value(i, k)); });
        } else {
            add(field.name, size, value);
        }
    }

    /// Writes the bytes of all arrays behind the other elements.
    void finish() {
        if (is_text_) {
            return;
        }
        file_.write("<AppendedData encoding=\"raw\">\n_");
        for (const auto& [size, append] : appended_) {
            std::string head;
            append_little_endian(head, size);
            file_.write(head);
            write_rows(file_, rows_, append);
        }
        file_.write("\n</AppendedData>\n");
    }

  private:
    using Append = std::function<void(std::string&, std::size_t, std::size_t)>;

    AtomicFile& file_;
    std::size_t rows_;
    bool is_text_;
    std::uint64_t offset_ = 0;
    std::vector<std::pair<std::uint64_t, Append>> appended_; ///< Sizes and bytes of the arrays.
};

/// Returns the entries of the header as arrays of text, whose characters VTK writes as numbers.
std::string field_data(const SampleHeader& header) {
    std::vector<std::string> keys;
    std::map<std::string, std::pair<std::size_t, std::string>> arrays;
    for (const auto& [key, value] : header.entries) {
        auto& [count, text] = arrays[key];
        if (count++ == 0) {
            keys.push_back(key);
        }
        for (const char c : value) {
            append_number(text, static_cast<unsigned>(static_cast<unsigned char>(c)));
            text += ' ';
        }
        text += "0\n";
    }
    std::string data;
    for (const std::string& key : keys) {
        const auto& [count, text] = arrays[key];
        data += "<Array type=\"String\" Name=\"" + key + "\" NumberOfTuples=\"" +
                std::to_string(count) + "\" format=\"ascii\">\n" + text + "</Array>\n";
    }
    return "<FieldData>\n" + data + "</FieldData>\n";
}

/// Writes the coordinates of a viewer, 0 where there are fewer than three.
void add_points(VtpArrays& arrays, std::span<const SampleRow> rows, const SampleLayout& layout) {
    if (layout.has_float_positions) {
        arrays.add("Points", 3, [rows](std::size_t i, std::size_t k) {
            return static_cast<float>(rows[i].position[k]);
        });
    } else {
        arrays.add("Points", 3,
                   [rows](std::size_t i, std::size_t k) { return rows[i].position[k]; });
    }
}

void add_point_data(VtpArrays& arrays, std::span<const SampleRow> rows,
                    const SampleLayout& layout) {
    if (layout.numbered() > 0) {
        arrays.add("coordinates", layout.numbered(),
                   [rows](std::size_t i, std::size_t k) { return rows[i].position[k]; });
    }
    if (layout.has_normals()) {
        arrays.add("Normals", 3,
                   [rows](std::size_t i, std::size_t k) { return rows[i].normal[k]; });
    }
    if (layout.is_on_surface) {
        arrays.add("face_index", 1, [rows](std::size_t i, std::size_t) { return rows[i].face; });
        arrays.add("barycentric", 3,
                   [rows](std::size_t i, std::size_t k) { return rows[i].bary[k]; });
    }
    if (layout.has_radius) {
        arrays.add("radius", 1, [rows](std::size_t i, std::size_t) { return rows[i].radius; });
    }
    if (layout.has_polygon) {
        arrays.add("polygon_index", 1,
                   [rows](std::size_t i, std::size_t) { return rows[i].polygon.value_or(0); });
    }
    for (const ExtraColumn& column : layout.further.numbers) {
        arrays.add(column.name, 1,
                   [&column](std::size_t i, std::size_t) { return column.values[i]; });
    }
    for (const SampleField& field : layout.further.fields) {
        arrays.add_field(field, layout.colours);
    }
}

} // namespace

void write_vtp(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleTarget& target, const SampleLayout& layout) {
    const std::string count = std::to_string(rows.size());
    file.write("<?xml version=\"1.0\"?>\n<!-- " + std::string(kVtpSamples) +
               " -->\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
               "header_type=\"UInt64\">\n<PolyData>\n" +
               field_data(header) + "<Piece NumberOfPoints=\"" + count + "\" NumberOfVerts=\"" +
               count +
               "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<Points>\n");
    VtpArrays arrays(file, rows.size(), target.is_text);
    add_points(arrays, rows, layout);
    file.write("</Points>\n<Verts>\n");
    arrays.add("connectivity", 1,
               [](std::size_t i, std::size_t) { return static_cast<std::int64_t>(i); });
    arrays.add("offsets", 1,
               [](std::size_t i, std::size_t) { return static_cast<std::int64_t>(i + 1); });
    file.write("</Verts>\n<PointData" +
               std::string(layout.has_normals() ? " Normals=\"Normals\"" : "") + ">\n");
    add_point_data(arrays, rows, layout);
    file.write("</PointData>\n</Piece>\n</PolyData>\n");
    arrays.finish();
    file.write("</VTKFile>\n");
}

} // namespace geodisk::tools
