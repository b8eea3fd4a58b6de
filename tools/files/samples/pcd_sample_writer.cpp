#include <array>
#include <concepts>
#include <set>
#include <string>

#include "files/output/block_writer.hpp"
#include "files/samples/sample_writers.hpp"
#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

/// As the Point Cloud Library calls it.
std::string field_name(std::string_view column) {
    return column.size() == 2 && column[0] == 'n' ? std::string("normal_") + column[1]
                                                  : std::string(column);
}

} // namespace

void write_pcd(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleTarget& target, const SampleLayout& exact) {
    SampleLayout layout = exact;
    layout.has_float_positions = true; // Doubles are read as something else.
    layout.is_text = target.is_text;
    layout.origin = origin_for_float(rows, layout.dimension);
    check_float_range(target, rows, layout.origin);
    SampleHeader all = header;
    if (layout.origin != std::array<double, 3>{}) {
        all.entries.emplace_back(kOrigin, exact_text(layout.origin[0]) + ' ' +
                                              exact_text(layout.origin[1]) + ' ' +
                                              exact_text(layout.origin[2]));
    }
    std::string fields, sizes, types, counts;
    std::set<std::string> names;
    visit_columns({}, 0, layout, [&](std::string_view name, auto value) {
        if (!names.insert(field_name(name)).second) {
            fail_same_name(target, field_name(name));
        }
        fields += ' ' + field_name(name);
        sizes += ' ' + std::to_string(sizeof value);
        types += std::floating_point<decltype(value)>    ? " F"
                 : std::signed_integral<decltype(value)> ? " I"
                                                         : " U";
        counts += " 1";
    });
    const std::string count = std::to_string(rows.size());
    file.write("# .PCD v0.7 - Point Cloud Data file format\n");
    file.write(entry_lines(all, target, "# "));
    file.write("VERSION 0.7\nFIELDS" + fields + "\nSIZE" + sizes + "\nTYPE" + types + "\nCOUNT" +
               counts + "\nWIDTH " + count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " +
               count + "\nDATA " + (target.is_text ? "ascii" : "binary") + '\n');
    write_each(file, rows.size(), [&](std::string& bytes, std::size_t i) {
        if (target.is_text) {
            append_text_row(bytes, rows[i], i, layout, ' ');
        } else {
            append_binary_row(bytes, rows[i], i, layout);
        }
    });
}

} // namespace geodisk::tools
