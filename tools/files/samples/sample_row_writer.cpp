#include "files/byte_order.hpp"
#include "files/samples/sample_writers.hpp"
#include "program/exact_text.hpp"

namespace geodisk::tools {

void append_text_row(std::string& text, const SampleRow& row, std::size_t index,
                     const SampleLayout& layout, char separator) {
    visit_columns(row, index, layout, [&](std::string_view, auto value) {
        append_number(text, value);
        text += separator;
    });
    text.back() = '\n';
}

void append_binary_row(std::string& bytes, const SampleRow& row, std::size_t index,
                       const SampleLayout& layout) {
    visit_columns(row, index, layout,
                  [&](std::string_view, auto value) { append_little_endian(bytes, value); });
}

} // namespace geodisk::tools
