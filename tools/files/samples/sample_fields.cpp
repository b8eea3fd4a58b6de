#include "files/samples/sample_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "files/images/colour_encoding.hpp"
#include "files/meshes/mesh_fields.hpp"
#include "files/output/block_writer.hpp"
#include "geometry/vertex_uvs.hpp"

namespace geodisk::tools {
namespace {

/// Writes the components at a sample to `out`.
void interpolate(const MeshFile& mesh, const MeshField& field, const SampleRow& row, double* out) {
    const std::size_t size = field.components.size(), first = std::size_t{3} * row.face;
    const auto values_at = [&](std::size_t k) {
        return &field.values[mesh.value_index(field, first + k) * size];
    };
    if (field.is_whole || field.of == MeshField::Of::faces) {
        const auto nearest = std::max_element(row.bary, row.bary + 3) - row.bary;
        std::copy_n(values_at(static_cast<std::size_t>(nearest)), size, out);
        return;
    }
    const double* const values[3] = {values_at(0), values_at(1), values_at(2)};
    const double sum = double{row.bary[0]} + double{row.bary[1]} + double{row.bary[2]};
    for (std::size_t i = 0; i < size; ++i) {
        double value = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            value += row.bary[k] / sum * values[k][i];
        }
        // Rounding leads out of the range of the corners by no more than the last bit.
        const auto [least, most] = std::minmax({values[0][i], values[1][i], values[2][i]});
        out[i] = std::clamp(value, least, most);
    }
}

/// Multiplies a colour by that of the vertices, if they have any: as light, or as they are.
void tint(const MeshFile& mesh, const SampleRow& row, std::span<double> colour) {
    if (!mesh.has_values(mesh.vertex_colours, row.face)) {
        return;
    }
    const MeshField& field = *mesh.vertex_colours;
    std::array<double, 4> by{};
    interpolate(mesh, field, row, by.data());
    for (std::size_t k = 0; k < colour.size(); ++k) {
        const double product =
            field.is_light ? encoded_light(by[k] * light_of(colour[k])) : by[k] * colour[k];
        colour[k] = std::clamp(by[k] == 1 ? colour[k] : product, 0.0, 1.0);
    }
}

/// Returns true if int32 holds all values.
bool fit_integers(std::span<const double> values) {
    return std::ranges::all_of(values, [](double x) {
        return x >= std::numeric_limits<std::int32_t>::min() &&
               x <= std::numeric_limits<std::int32_t>::max() && std::trunc(x) == x;
    });
}

} // namespace

std::vector<SampleField> sample_fields(const MeshFile& mesh, std::span<const SampleRow> rows) {
    std::vector<SampleField> fields;
    for (const MeshField& field : mesh.fields) {
        const std::size_t size = field.components.size();
        SampleField& result = fields.emplace_back(
            SampleField{field.name, field.components, field.is_whole, field.is_colour,
                        std::vector<double>(rows.size() * size)});
        for_rows(rows.size(), [&](std::size_t i) {
            double* const value = &result.values[i * size];
            interpolate(mesh, field, rows[i], value);
            if (field.is_light) {
                encode_colour({value, size});
            }
        });
        result.is_whole = field.is_whole && fit_integers(result.values);
    }
    return fields;
}

SampleField texture_colours(const MeshFile& mesh, const Textures& textures,
                            std::span<const SampleRow> rows) {
    const MeshField like = make_colours(MeshField::Of::corners, 3);
    SampleField colours{like.name, like.components, false, true,
                        std::vector<double>(3 * rows.size())};
    for_rows(rows.size(), [&](std::size_t i) {
        double* const colour = &colours.values[3 * i];
        std::fill_n(colour, 3, 1.0);
        const MaterialColour* const material = textures.material(mesh, rows[i].face);
        if (material == nullptr) {
            tint(mesh, rows[i], {colour, 3});
            return;
        }
        std::optional<std::array<double, 2>> place;
        std::array<double, 2> centre{};
        if (material->image && mesh.has_texture_uvs(rows[i].face)) {
            double uv[2];
            interpolate(mesh, *mesh.texture_uvs, rows[i], uv);
            place = material->place(uv[0], uv[1]);
            (*place)[1] = mesh.texture_uvs->is_from_top ? 1 - (*place)[1] : (*place)[1];
            centre = image_centre(mesh, *material, rows[i].face);
        }
        std::ranges::copy(textures.colour(*material, place, centre), colour);
        if (mesh.vertex_colours && mesh.vertex_colours->is_light) { // As glTF has it.
            tint(mesh, rows[i], {colour, 3});
        }
    });
    return colours;
}

Vec3 file_normal(const MeshFile& mesh, const SampleRow& row) {
    Vec3 normal{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double* const n =
            &mesh.normals
                 ->values[3 * mesh.value_index(*mesh.normals, std::size_t{3} * row.face + k)];
        normal += double{row.bary[k]} * Vec3{n[0], n[1], n[2]};
    }
    return normal;
}

} // namespace geodisk::tools
