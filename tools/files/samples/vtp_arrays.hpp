// Writing VTK's XML files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/byte_order.hpp"
#include "files/images/colour_encoding.hpp"
#include "files/output/block_writer.hpp"
#include "files/output/output_file.hpp"
#include "files/samples/sample_file.hpp"
#include "program/exact_text.hpp"

namespace geodisk::tools {

inline std::string_view vtp_type(std::uint8_t) {
    return "UInt8";
}
inline std::string_view vtp_type(std::int32_t) {
    return "Int32";
}
inline std::string_view vtp_type(std::uint32_t) {
    return "UInt32";
}
inline std::string_view vtp_type(std::int64_t) {
    return "Int64";
}
inline std::string_view vtp_type(float) {
    return "Float32";
}
inline std::string_view vtp_type(double) {
    return "Float64";
}

/// Appends a number as text; a byte is no character.
template <typename Value>
void append_vtp_number(std::string& text, Value value) {
    if constexpr (sizeof value == 1) {
        append_number(text, static_cast<unsigned>(value));
    } else {
        append_number(text, value);
    }
}

/// Writes a file: its arrays in text inside their elements, or else as bytes behind the XML.
class VtpArrays {
  public:
    /// Begins the file with its root, behind a comment unless that is "".
    VtpArrays(AtomicFile& file, bool is_text, std::string_view comment = {})
        : file_(file), is_text_(is_text) {
        file_.write("<?xml version=\"1.0\"?>\n" +
                    (comment.empty() ? "" : "<!-- " + std::string(comment) + " -->\n") +
                    "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
                    "header_type=\"UInt64\">\n<PolyData>\n");
    }

    /// Writes an array, or where its bytes will be; `value(i, k)` is component k of row i. It must
    /// outlive the file.
    template <class Value>
    void add(const std::string& name, std::size_t rows, std::size_t components,
             const Value& value) {
        using Number = decltype(value(0, 0));
        file_.write("<DataArray type=\"" + std::string(vtp_type(Number{})) + "\" Name=\"" + name +
                    "\" NumberOfComponents=\"" + std::to_string(components) + "\" format=\"");
        const bool is_text = is_text_;
        Append append = [=](std::string& bytes, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                for (std::size_t k = 0; k < components; ++k) {
                    if (is_text) {
                        append_vtp_number(bytes, value(i, k));
                        bytes += k + 1 < components ? ' ' : '\n';
                    } else {
                        append_little_endian(bytes, value(i, k));
                    }
                }
            }
        };
        if (is_text_) {
            file_.write("ascii\">\n");
            write_rows(file_, rows, append);
            file_.write("</DataArray>\n");
            return;
        }
        const std::uint64_t size = rows * components * sizeof(Number);
        file_.write("appended\" offset=\"" + std::to_string(offset_) + "\"/>\n");
        offset_ += sizeof size + size;
        appended_.push_back({size, rows, std::move(append)});
    }

    /// Writes the values of an attribute, colours as bytes.
    void add_field(const SampleField& field, std::size_t rows) {
        const std::size_t size = field.components.size();
        const auto value = [&field, size](std::size_t i, std::size_t k) {
            return field.values[i * size + k];
        };
        if (field.is_whole) {
            add(field.name, rows, size, [value](std::size_t i, std::size_t k) {
                return static_cast<std::int32_t>(value(i, k));
            });
        } else if (field.is_colour) {
            add(field.name, rows, size,
                [value](std::size_t i, std::size_t k) { return colour_byte(value(i, k)); });
        } else if (field.is_float) {
            add(field.name, rows, size,
                [value](std::size_t i, std::size_t k) { return static_cast<float>(value(i, k)); });
        } else {
            add(field.name, rows, size, value);
        }
    }

    /// Ends the file, with the bytes of all arrays behind the other elements.
    void finish() {
        file_.write("</PolyData>\n");
        if (!is_text_) {
            write_appended();
        }
        file_.write("</VTKFile>\n");
    }

  private:
    using Append = std::function<void(std::string&, std::size_t, std::size_t)>;

    struct Appended {
        std::uint64_t size;
        std::size_t rows;
        Append append;
    };

    void write_appended() {
        file_.write("<AppendedData encoding=\"raw\">\n_");
        for (const Appended& one : appended_) {
            std::string head;
            append_little_endian(head, one.size);
            file_.write(head);
            write_rows(file_, one.rows, one.append);
        }
        file_.write("\n</AppendedData>\n");
    }

    AtomicFile& file_;
    bool is_text_;
    std::uint64_t offset_ = 0;
    std::vector<Appended> appended_;
};

} // namespace geodisk::tools
