// The colours of the materials of an OBJ file, from its MTL files.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "files/meshes/file_scope.hpp"
#include "geometry/material_colours.hpp"
#include "geometry/mesh_warning.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// Reads `Kd` and `map_Kd` of materials, and their images. `libraries` are the texts behind each
/// `mtllib` of the file `obj`. `names` are those of the materials; nothing for those that no face
/// uses. Files beyond `scope` are refused. Of materials of the same name, the first one counts.
/// Throws UserError(bad_input) naming the MTL file, and its line or material.
MaterialColours read_mtl_files(const Path& obj, std::span<const std::string> libraries,
                               std::span<const std::optional<std::string>> names,
                               const FileScope& scope, std::vector<MeshWarning>& warnings);

} // namespace geodisk::tools
