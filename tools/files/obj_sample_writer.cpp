#include "files/sample_writers.hpp"
#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

template <class Number>
void write_triple(AtomicFile& file, std::string& line, std::string_view name,
                  const Number* triple) {
    line.clear();
    line += name;
    for (int axis = 0; axis < 3; ++axis) {
        line += ' ';
        append_number(line, triple[axis]);
    }
    file.write(line += '\n');
}

} // namespace

void write_obj(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleLayout& layout) {
    write_entries(file, header, "# ");
    std::string line;
    for (const SampleRow& row : rows) {
        write_triple(file, line, "v", row.position);
    }
    if (layout.has_normals()) {
        for (const SampleRow& row : rows) {
            write_triple(file, line, "vn", row.normal);
        }
    }
    for (std::size_t i = 1; i <= rows.size(); ++i) {
        file.write("p " + std::to_string(i) + '\n');
    }
}

} // namespace geodisk::tools
