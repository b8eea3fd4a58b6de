#include "files/block_writer.hpp"
#include "files/byte_order.hpp"
#include "files/sample_writers.hpp"
#include "program/exact_text.hpp"

namespace geodisk::tools {

void write_text_rows(AtomicFile& file, std::span<const SampleRow> rows, const SampleLayout& layout,
                     char separator) {
    write_rows(file, rows.size(), [&](std::string& text, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            visit_columns(rows[i], i, layout, [&](std::string_view, auto value) {
                append_number(text, value);
                text += separator;
            });
            text.back() = '\n';
        }
    });
}

void write_binary_rows(AtomicFile& file, std::span<const SampleRow> rows,
                       const SampleLayout& layout) {
    write_rows(file, rows.size(), [&](std::string& bytes, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            visit_columns(rows[i], i, layout, [&](std::string_view, auto value) {
                append_little_endian(bytes, value);
            });
        }
    });
}

} // namespace geodisk::tools
