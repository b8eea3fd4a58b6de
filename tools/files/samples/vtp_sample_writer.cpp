#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "files/samples/sample_writers.hpp"
#include "files/samples/vtp_arrays.hpp"
#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

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
        data += "<Array type=\"String\" Name=\"" + key + "\" NumberOfTuples=\"";
        data += std::to_string(count) + "\" format=\"ascii\">\n";
        data += text + "</Array>\n";
    }
    return "<FieldData>\n" + data + "</FieldData>\n";
}

/// Writes the coordinates of a viewer, 0 where there are fewer than three.
void add_points(VtpArrays& arrays, std::span<const SampleRow> rows, const SampleLayout& layout) {
    if (layout.has_float_positions) {
        arrays.add("Points", rows.size(), 3, [rows](std::size_t i, std::size_t k) {
            return static_cast<float>(rows[i].position[k]);
        });
    } else {
        arrays.add("Points", rows.size(), 3,
                   [rows](std::size_t i, std::size_t k) { return rows[i].position[k]; });
    }
}

void add_point_data(VtpArrays& arrays, std::span<const SampleRow> rows, const SampleTarget& target,
                    const SampleLayout& layout) {
    if (layout.numbered() > 0) {
        constexpr const char* kName = "coordinates";
        if (std::ranges::find(layout.further.fields, std::string(kName), &SampleField::name) !=
            layout.further.fields.end()) {
            fail_same_name(target, kName);
        }
        arrays.add(kName, rows.size(), layout.numbered(),
                   [rows](std::size_t i, std::size_t k) { return rows[i].position[k]; });
    }
    if (layout.has_normals()) {
        arrays.add("Normals", rows.size(), 3,
                   [rows](std::size_t i, std::size_t k) { return rows[i].normal[k]; });
    }
    if (layout.is_on_surface) {
        arrays.add("face_index", rows.size(), 1,
                   [rows](std::size_t i, std::size_t) { return rows[i].face; });
        arrays.add("barycentric", rows.size(), 3,
                   [rows](std::size_t i, std::size_t k) { return rows[i].bary[k]; });
    }
    if (layout.has_radius) {
        arrays.add("radius", rows.size(), 1,
                   [rows](std::size_t i, std::size_t) { return rows[i].radius; });
    }
    if (layout.has_polygon) {
        arrays.add("polygon_index", rows.size(), 1,
                   [rows](std::size_t i, std::size_t) { return rows[i].polygon.value_or(0); });
    }
    for (const ExtraColumn& column : layout.further.numbers) {
        arrays.add(column.name, rows.size(), 1,
                   [&column](std::size_t i, std::size_t) { return column.values[i]; });
    }
    for (const SampleField& field : layout.further.fields) {
        arrays.add_field(field, rows.size());
    }
}

} // namespace

void write_vtp(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleTarget& target, const SampleLayout& layout) {
    const std::string count = std::to_string(rows.size());
    VtpArrays arrays(file, target.is_text, kVtpSamples);
    file.write(field_data(header) + "<Piece NumberOfPoints=\"" + count + "\" NumberOfVerts=\"" +
               count +
               "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<Points>\n");
    add_points(arrays, rows, layout);
    file.write("</Points>\n<Verts>\n");
    arrays.add("connectivity", rows.size(), 1,
               [](std::size_t i, std::size_t) { return static_cast<std::int64_t>(i); });
    arrays.add("offsets", rows.size(), 1,
               [](std::size_t i, std::size_t) { return static_cast<std::int64_t>(i + 1); });
    file.write("</Verts>\n<PointData" +
               std::string(layout.has_normals() ? " Normals=\"Normals\"" : "") + ">\n");
    add_point_data(arrays, rows, target, layout);
    file.write("</PointData>\n</Piece>\n");
    arrays.finish();
}

} // namespace geodisk::tools
