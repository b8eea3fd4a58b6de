#include "files/output/block_writer.hpp"
#include "files/samples/sample_writers.hpp"
#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

template <class Number>
void append_triple(std::string& text, std::string_view name, const Number* triple) {
    text += name;
    for (int axis = 0; axis < 3; ++axis) {
        text += ' ';
        append_number(text, triple[axis]);
    }
    text += '\n';
}

} // namespace

void write_obj(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleTarget& target, const SampleLayout& layout) {
    file.write(entry_lines(header, target, "# "));
    // Writes what `append(text, i)` appends for each row.
    const auto write_each = [&](const auto& append) {
        write_rows(file, rows.size(), [&](std::string& text, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                append(text, i);
            }
        });
    };
    write_each(
        [&](std::string& text, std::size_t i) { append_triple(text, "v", rows[i].position); });
    if (layout.has_normals()) {
        write_each(
            [&](std::string& text, std::size_t i) { append_triple(text, "vn", rows[i].normal); });
    }
    write_each([](std::string& text, std::size_t i) {
        text += "p ";
        append_number(text, i + 1);
        text += '\n';
    });
}

} // namespace geodisk::tools
