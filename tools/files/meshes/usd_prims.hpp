// The prims of a USD file: a tree of what has a place, and the attributes that make surfaces.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat4x4.hpp>

#include "files/meshes/mesh_fields.hpp"
#include "files/meshes/usd_text.hpp"
#include "geometry/mesh_warning.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

struct UsdAttribute {
    std::string name; ///< "primvars:st".
    std::string type; ///< "texCoord2f".
    std::string interpolation;
    UsdValue value;
    bool is_read = false; ///< False for a value that nobody asked for.
};

struct UsdPrim {
    std::string type, name;
    std::string path; ///< "</World/Mesh>".
    std::uint32_t line = 0;
    std::vector<UsdAttribute> attributes;
    std::vector<UsdPrim> children;

    /// Returns the attribute with a value; null without one.
    const UsdAttribute* find(std::string_view attribute) const;
    /// Returns the first text of an attribute; "" without one.
    std::string text(std::string_view attribute) const;
};

/// A file, or what of it matters.
struct UsdScene {
    std::vector<UsdPrim> prims;
    double metres_per_unit = 0; ///< 0 where the file does not say.
    std::string up;             ///< "Y", or "" where the file does not say.
    std::uint64_t sampled = 0;  ///< Attributes whose first value in time was taken.
};

/// The attribute of a mesh file that a primvar is: "color" for displayColor, without values.
/// Returns no components for texts.
MeshField field_of_primvar(std::string_view name, std::string_view type);

/// Parses the text of a file, with values that meshes need and those of `wanted`. Throws
/// UserError(bad_input) naming the line; also for references and variants, whose prims are in other
/// places.
UsdScene parse_usd(const Path& path, std::string_view text, const WantedFields& wanted);

/// Returns how the operations of a prim move points, and sets `is_reset` if what is above has no
/// effect on it. Throws UserError(bad_input).
glm::dmat4 usd_transform(const UsdText& text, const UsdPrim& prim, bool& is_reset);

} // namespace geodisk::tools
