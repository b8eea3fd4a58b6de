#include "files/samples/row_format.hpp"

#include <span>
#include <string_view>

#include "files/output/block_writer.hpp"
#include "files/samples/sample_writers.hpp"
#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

const char* ply_type(std::uint32_t) {
    return "int";
}
const char* ply_type(std::int32_t) {
    return "int";
}
const char* ply_type(std::uint8_t) {
    return "uchar";
}
const char* ply_type(float) {
    return "float";
}
const char* ply_type(double) {
    return "double";
}

std::string ply_head(const SampleHeader& header, std::uint64_t count, const SampleTarget& target,
                     const SampleLayout& layout) {
    std::string head =
        target.is_text ? "ply\nformat ascii 1.0\n" : "ply\nformat binary_little_endian 1.0\n";
    head += entry_lines(header, target, "comment ");
    head += "element vertex " + std::to_string(count) + '\n';
    return head + ply_properties(layout) + "end_header\n";
}

std::string csv_head(const SampleHeader& header, std::uint64_t count, const SampleTarget& target,
                     const SampleLayout& layout) {
    std::string head = entry_lines(header, target, "# ");
    if (!head.empty()) {
        head += "# " + std::string(kSampleCount) + ": " + std::to_string(count) + '\n';
    }
    const std::size_t first = head.size();
    visit_columns({}, 0, layout, [&](std::string_view name, auto) {
        head += head.size() == first ? "" : ",";
        head += name;
    });
    return head + '\n';
}

void append_point(std::string& text, const SampleRow& row) {
    for (const double coordinate : std::span(row.position).first(3)) {
        append_number(text, coordinate);
        text += ' ';
    }
    text.back() = '\n';
}

} // namespace

std::string ply_properties(const SampleLayout& layout) {
    std::string lines;
    visit_columns({}, 0, layout, [&](std::string_view name, auto value) {
        lines += std::string("property ") + ply_type(value) + ' ' + std::string(name) + '\n';
    });
    return lines;
}

bool RowFormat::is_one(SampleFormat format) {
    return facts_of(format).write == write_by_row;
}

RowFormat::RowFormat(const SampleTarget& target, const SampleLayout& layout)
    : target_(target), layout_(layout) {}

std::string RowFormat::head(const SampleHeader& header, std::uint64_t count) const {
    return target_.format == SampleFormat::ply   ? ply_head(header, count, target_, layout_)
           : target_.format == SampleFormat::csv ? csv_head(header, count, target_, layout_)
                                                 : "";
}

void RowFormat::append(std::string& bytes, const SampleRow& row, std::size_t index) const {
    if (target_.format == SampleFormat::xyz) {
        append_point(bytes, row);
    } else if (target_.format == SampleFormat::csv) {
        append_text_row(bytes, row, index, layout_, ',');
    } else if (target_.is_text) {
        append_text_row(bytes, row, index, layout_, ' ');
    } else {
        append_binary_row(bytes, row, index, layout_);
    }
}

void write_by_row(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
                  const SampleTarget& target, const SampleLayout& layout) {
    const RowFormat format(target, layout);
    file.write(format.head(header, rows.size()));
    write_each(file, rows.size(),
               [&](std::string& bytes, std::size_t i) { format.append(bytes, rows[i], i); });
}

} // namespace geodisk::tools
