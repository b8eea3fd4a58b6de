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
    write_each(file, rows.size(), [&](std::string& text, std::size_t i) {
        append_triple(text, "v", rows[i].position);
    });
    if (layout.has_normals()) {
        write_each(file, rows.size(), [&](std::string& text, std::size_t i) {
            append_triple(text, "vn", rows[i].normal);
        });
    }
    write_each(file, rows.size(), [](std::string& text, std::size_t i) {
        text += "p ";
        append_number(text, i + 1);
        text += '\n';
    });
}

} // namespace geodisk::tools
