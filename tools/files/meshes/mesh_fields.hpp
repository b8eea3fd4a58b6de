// The attributes of mesh files that are read, to be interpolated at samples or as numbers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh.hpp"
#include "program/failure.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

struct PolygonMesh;

/// Names of attributes that several formats have.
inline constexpr std::string_view kColourField = "color", kUvField = "uv";

/// Stands for the materials of a mesh, in place of the name of an image.
inline constexpr std::string_view kAutoTexture = "auto";

/// The attributes of a mesh file to read.
struct WantedFields {
    std::vector<std::string> names;
    bool all = false;                 ///< All that the file has.
    std::vector<std::string> numbers; ///< Names of MeshFile::numbers.
    bool normals = false;             ///< The normals of the file too, which are no attribute.
    bool uvs = false;                 ///< Texture coordinates too, to look up a texture.
    bool materials = false;   ///< Colours of materials too, with their images and coordinates.
    bool has_texture = false; ///< Samples get colours beside the attributes.

    /// Returns true for what is to be read.
    bool has(std::string_view name) const;
    /// Returns true for what is to be read even if not all attributes are.
    bool needs(std::string_view name) const;
    /// Returns true for what is to be written: by its name, or by that of a component, as "red".
    bool lists(std::string_view name) const;
    /// Returns which of `names` means it, or their number for none.
    std::size_t place_of(std::string_view name) const;
    /// Returns true if any attribute is to be read; normals are none.
    bool are_given() const { return all || uvs || materials || !names.empty() || !numbers.empty(); }
};

/// Reads "all", or names with commas between; nothing for "". Throws UserError(usage) for an empty
/// name and one that repeats.
WantedFields parse_fields(const std::string& text);

/// Returns an attribute without values, of one number or of several: "f_0", "f_1".
MeshField make_field(std::string_view name, MeshField::Of of, std::size_t components = 1);
/// Returns colours of 3 components, or of 4 with alpha; `prefix` begins their names.
MeshField make_colours(MeshField::Of of, std::size_t components, const std::string& prefix = "");
/// Returns texture coordinates, whose values are PolygonMesh::uvs.
MeshField make_uvs();

/// Returns true if an attribute of `polygons`, a component or an own column has this name.
bool lists_name(const PolygonMesh& polygons, std::string_view name);

/// Divides colours by 255 if some are larger than 1.
void scale_colours(MeshField& colours);

/// Warns that an attribute is left out because of `error`.
void warn_left_out(const Path& path, std::string_view name, const UserError& error,
                   std::vector<MeshWarning>& warnings);

/// Moves the wanted attributes and numbers into `mesh`, which has its parts, and whose faces are
/// split already but not joined. The name of a number is that of an attribute or of one of its
/// components, as "red"; "color" is the luminance.
/// Throws UserError(bad_input) for those that the file lacks or has for some corners only, values
/// that are not finite, and names of other columns. With WantedFields::all, these are left out,
/// with a warning. Beside a texture, "color" becomes "vertex_color" or "face_color".
void take_fields(const Path& path, const WantedFields& wanted, PolygonMesh& polygons,
                 MeshFile& mesh);

} // namespace geodisk::tools
