// The columns of sample files and what else their formats share, for the writers.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "files/images/colour_encoding.hpp"
#include "files/meshes/mesh_fields.hpp"
#include "files/output/output_file.hpp"
#include "files/samples/sample_columns.hpp"
#include "files/samples/sample_file.hpp"

namespace geodisk::tools {

/// Columns of a file.
struct SampleLayout {
    std::uint32_t dimension;
    std::uint32_t named; ///< Number of coordinates that have the names x, y and z.
    bool has_float_positions;
    bool has_radius;
    bool has_polygon = false;
    bool is_on_surface = true;
    FurtherColumns further = {};
    std::array<double, 3> origin{}; ///< Origin that x, y and z are relative to.
    bool has_float_numbered = has_float_positions;
    ColourEncoding colours = ColourEncoding::srgb;
    bool is_text = false; ///< Numbers are written as text.

    std::size_t numbered() const { return dimension > 3 ? dimension : 0; }
    bool has_normals() const { return is_on_surface && dimension == 3; }
};

/// Returns the frames among the attributes, or null.
inline const SampleField* find_frames(const FurtherColumns& further) {
    const auto found = std::ranges::find(further.fields, kFramesField, &SampleField::name);
    return found == further.fields.end() ? nullptr : &*found;
}

/// Returns component k of row i of an attribute in a format where colours are of that encoding.
inline double field_value(const SampleField& field, std::size_t i, std::size_t k,
                          ColourEncoding encoding) {
    const double value = field.values[i * field.components.size() + k];
    return field.is_colour && encoding == ColourEncoding::light ? colour_light(value, k) : value;
}

/// Calls visit(name, value) for a colour in one number: "rgb", in binary a float with those bits,
/// or "rgba".
template <typename Visit>
void visit_packed(const SampleField& field, std::size_t index, const SampleLayout& layout,
                  const Visit& visit) {
    const std::size_t size = field.components.size();
    const bool is_known = (index + 1) * size <= field.values.size();
    const std::uint32_t packed =
        is_known ? packed_colour(std::span(field.values).subspan(index * size, size)) : 0;
    if (size > kAlpha || layout.is_text) {
        visit(std::string_view(size > kAlpha ? "rgba" : "rgb"), packed);
    } else {
        visit(std::string_view("rgb"), std::bit_cast<float>(packed));
    }
}

/// Calls visit(name, value) for each component of an attribute.
template <typename Visit>
void visit_field(const SampleField& field, std::size_t index, const SampleLayout& layout,
                 const Visit& visit) {
    const bool has_bytes = field.is_colour && (layout.colours == ColourEncoding::bytes ||
                                               layout.colours == ColourEncoding::packed);
    if (layout.colours == ColourEncoding::packed && field.name == kColourField) {
        visit_packed(field, index, layout, visit);
        return;
    }
    const std::size_t size = field.components.size();
    for (std::size_t k = 0; k < size; ++k) {
        const std::string_view name = field.components[k];
        const double value = (index + 1) * size <= field.values.size()
                                 ? field_value(field, index, k, layout.colours)
                                 : 0;
        if (field.is_whole) {
            visit(name, static_cast<std::int32_t>(value));
        } else if (has_bytes) {
            visit(name, colour_byte(value));
        } else if (field.is_float) {
            visit(name, static_cast<float>(value));
        } else {
            visit(name, value);
        }
    }
}

/// Calls visit(name, value) for each column of row `index`, in order; some value for no row.
template <typename Visit>
void visit_columns(const SampleRow& row, std::size_t index, const SampleLayout& layout,
                   const Visit& visit) {
    const auto visit_position = [&](std::string_view name, double value, bool is_float) {
        if (is_float) {
            visit(name, static_cast<float>(value));
        } else {
            visit(name, value);
        }
    };
    const auto name_of = [](SampleColumn first, std::size_t offset = 0) {
        return kSampleColumnNames[static_cast<std::size_t>(first) + offset];
    };
    for (std::size_t axis = 0; axis < layout.named; ++axis) {
        visit_position(kSampleColumnNames[axis], row.position[axis] - layout.origin[axis],
                       layout.has_float_positions);
    }
    for (std::size_t axis = 0; axis < layout.numbered(); ++axis) {
        visit_position(kNumberedColumnNames[axis], row.position[axis], layout.has_float_numbered);
    }
    for (std::size_t axis = 0; axis < 3 && layout.has_normals(); ++axis) {
        visit(name_of(SampleColumn::nx, axis), row.normal[axis]);
    }
    if (layout.is_on_surface) {
        visit(name_of(SampleColumn::face_index), row.face);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            visit(name_of(SampleColumn::bary_u, corner), row.bary[corner]);
        }
    }
    if (layout.has_radius) {
        visit(name_of(SampleColumn::radius), row.radius);
    }
    if (layout.has_polygon) {
        visit(name_of(SampleColumn::polygon_index), row.polygon.value_or(0));
    }
    for (const ExtraColumn& column : layout.further.numbers) {
        visit(std::string_view(column.name),
              index < column.values.size() ? column.values[index] : 0);
    }
    for (const SampleField& field : layout.further.fields) {
        visit_field(field, index, layout, visit);
    }
}

/// The bounding box of samples.
struct SampleBox {
    double least[8], most[8]; ///< In each dimension; infinite without samples.

    SampleBox();
    explicit SampleBox(std::span<const SampleRow> rows);
    /// Takes in another box.
    void add(const SampleBox& other);
};

/// Returns true if rounding to float moves no position by more than a millionth of the set's
/// extent.
bool float_is_enough(const SampleBox& box, std::uint32_t dimension);

/// Returns the columns of samples on a surface in a format.
SampleLayout layout_in(SampleFormat format, std::uint32_t dimension, bool is_float_enough);

/// The middle of the samples' bounding box, of x y z; 0 without samples.
std::array<double, 3> middle_of(std::span<const SampleRow> rows);

/// Returns where to put the origin of x y z in float: 0 unless float would blur them.
std::array<double, 3> origin_for_float(std::span<const SampleRow> rows, std::uint32_t dimension);

/// Throws UserError(usage) if x y z relative to `origin`, or the radii, are too large or too small
/// for float.
void check_float_range(const SampleTarget& target, std::span<const SampleRow> rows,
                       const std::array<double, 3>& origin);

/// Returns a line "KEY: VALUE" behind `prefix` for each entry; none if the target has no header.
std::string entry_lines(const SampleHeader& header, const SampleTarget& target, const char* prefix);

/// An object of all entries, plain ASCII on one line; a key with several values has an array.
std::string json_text(const SampleHeader& header);

} // namespace geodisk::tools
