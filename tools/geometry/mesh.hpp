// Triangle meshes as read from files or generated, before the library prepares them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "geometry/material_colours.hpp"
#include "geometry/mesh_warning.hpp"

namespace geodisk::tools {

/// Fewest and most coordinates a vertex may have in a file.
inline constexpr std::uint32_t kFewestCoordinates = 3;
inline constexpr std::uint32_t kMaxCoordinates = 8;

/// A part of a mesh file, as the file divides its faces: a primitive that a node places, or faces
/// of the same material and groups.
struct MeshPart {
    std::optional<std::uint32_t> node, mesh, primitive; ///< Their numbers in a glTF file.
    std::optional<std::uint32_t> material;              ///< Its number in PartNames.
    std::vector<std::uint32_t> groups;                  ///< Their numbers in PartNames.
};

/// Names by number; "" for what has none.
struct PartNames {
    std::vector<std::string> materials, groups, nodes;
    std::vector<std::optional<std::uint32_t>> node_above; ///< Node that each one is below.
};

/// A name that a file gives to a value, such as that of a region of a brain.
struct ValueName {
    std::string name;
    double value = 0;
};

/// Values of an attribute of a mesh file: colours, texture coordinates or any others.
struct MeshField {
    enum class Of : std::uint8_t { vertices, corners, faces };

    std::string name;                    ///< As --attributes names it.
    std::vector<std::string> components; ///< Names of the numbers of each value.
    Of of = Of::vertices;
    bool is_whole = false;      ///< Integers and labels, which are not interpolated.
    bool is_colour = false;     ///< From 0 to 1.
    bool is_light = false;      ///< Colours are amounts of light; else as sRGB encodes them.
    bool is_from_top = false;   ///< Texture coordinates have v = 0 at the top of an image.
    std::vector<double> values; ///< All components of each vertex, index of a corner, or face.
    /// Index of the value of each corner, or kNone. Empty unless corners have values.
    std::vector<std::uint32_t> corners;
    std::vector<ValueName> value_names; ///< Names of values, where the file has any.

    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
};

/// Counts of what joining vertices did.
struct WeldCounts {
    std::uint64_t merged_vertices = 0;  ///< Vertices that became another one.
    std::uint64_t degenerate_faces = 0; ///< Triangles that take no part since.
    std::uint64_t joined_edges = 0;     ///< Border edges joined to others along seams.
};

/// A mesh as read: `positions` holds `dimension` coordinates per vertex, `triangles` three vertex
/// indices each. Vertices are those of the file, in its order, also the unused.
///
/// A face of k >= 3 corners makes exactly k - 2 triangles, in file order, whatever becomes of them;
/// one of fewer corners makes none. So triangles have the same numbers in every program that splits
/// faces in place. A triangle that is dropped names a vertex twice, and then takes no part.
struct MeshFile {
    std::vector<double> positions; ///< Empty for a mesh of edge lengths without coordinates.
    std::vector<std::uint32_t> triangles;
    /// The file's face that each triangle is of, from 0. Empty where all faces are triangles, so
    /// that the numbers are the same.
    std::vector<std::uint32_t> polygons;
    std::uint32_t polygon_count = 0; ///< Faces of the file, where `polygons` is not empty.
    /// Parts that the file divides its faces into, if it does, and the index there of each
    /// triangle's.
    std::vector<MeshPart> parts;
    std::vector<std::uint32_t> part_of_triangle;
    PartNames part_names;
    std::uint32_t dimension = 3;
    /// Lengths of the edges of each triangle, from corner to corner, if they and not the positions
    /// make the surface; else empty.
    std::vector<double> lengths;
    /// Numbers asked for by name: fields of one component, which may be not finite.
    std::vector<MeshField> numbers;
    /// Attributes asked for, by vertices and triangles' corners of the file, and by its faces.
    std::vector<MeshField> fields;
    std::optional<MeshField> normals; ///< Those of the file, where asked for; not of unit length.
    /// Texture coordinates, where textures are looked up; with gaps if materials have them.
    std::optional<MeshField> texture_uvs;
    std::optional<MaterialColours> materials; ///< Colours of materials, if asked for.
    /// Colours of vertices, where those of materials are asked for; with gaps.
    std::optional<MeshField> vertex_colours;
    std::optional<WeldCounts> weld; ///< Set if vertices were joined.
    /// Lowest vertex that each one is joined with. Empty where none are.
    std::vector<std::uint32_t> joined;
    /// Vertex of the file that each one behind those of the file is a copy of, where walls cut.
    std::vector<std::uint32_t> copied;
    /// Corners of triangles as the file has them, where vertices are joined or copied. Else empty.
    std::vector<std::uint32_t> file_triangles;
    ElementNames names;
    std::vector<MeshWarning> warnings; ///< Warnings about what was dropped or ignored.

    std::size_t triangle_count() const { return triangles.size() / 3; }
    /// Returns the number of vertices; without coordinates, of those up to the last in a face.
    std::size_t vertex_count() const {
        return positions.empty()
                   ? triangles.empty() ? 0 : std::size_t{1} + *std::ranges::max_element(triangles)
                   : positions.size() / dimension;
    }
    /// Returns the number of vertices of the file, of the mesh's.
    std::size_t file_vertices(std::size_t vertices) const { return vertices - copied.size(); }
    /// Returns the vertex of the file that a vertex is or is a copy of.
    std::uint32_t file_vertex(std::size_t vertex, std::size_t vertices) const {
        const std::size_t own = file_vertices(vertices);
        return vertex < own ? static_cast<std::uint32_t>(vertex) : copied[vertex - own];
    }
    /// Vertices of all corners, before any were joined or copied.
    const std::vector<std::uint32_t>& corners_in_file() const {
        return file_triangles.empty() ? triangles : file_triangles;
    }
    /// Returns the number of that name, which was asked for.
    const MeshField& number(const std::string& name) const {
        return *std::ranges::find(numbers, name, &MeshField::name);
    }
    /// Returns the index of the value that a corner of a triangle has.
    std::size_t value_index(const MeshField& field, std::size_t corner) const {
        switch (field.of) {
        case MeshField::Of::vertices:
            return corners_in_file()[corner];
        case MeshField::Of::corners:
            return field.corners[corner];
        case MeshField::Of::faces:
            break;
        }
        return polygons.empty() ? corner / 3 : polygons[corner / 3];
    }
    /// Its face, in the words of the file.
    std::string name_of_triangle(std::size_t triangle) const {
        return names.of_face(polygons.empty() ? triangle : polygons[triangle]);
    }
    /// Returns the colour of a triangle's material; null for a triangle without.
    const MaterialColour* material_colour(std::size_t triangle) const {
        const std::optional<std::uint32_t> number =
            parts.empty() ? std::nullopt : parts[part_of_triangle[triangle]].material;
        const bool is_known = materials && number && *number < materials->colours.size();
        return is_known && materials->colours[*number] ? &*materials->colours[*number] : nullptr;
    }
    /// Returns true if all corners of a triangle have texture coordinates.
    bool has_texture_uvs(std::size_t triangle) const { return has_values(texture_uvs, triangle); }
    /// Returns true if all corners of a triangle have a value of the field.
    bool has_values(const std::optional<MeshField>& field, std::size_t triangle) const {
        return field &&
               (field->of != MeshField::Of::corners ||
                std::none_of(&field->corners[3 * triangle], &field->corners[3 * triangle] + 3,
                             [](std::uint32_t i) { return i == MeshField::kNone; }));
    }
    /// Returns true if the triangle names three vertices.
    bool takes_part(std::size_t triangle) const {
        const std::uint32_t* const v = &triangles[3 * triangle];
        return v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
    }
};

} // namespace geodisk::tools
