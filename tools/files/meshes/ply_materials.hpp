// The images that a PLY file names in its comments, as programs for scans write them.
#pragma once

#include "files/meshes/file_scope.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "files/ply_file.hpp"

namespace geodisk::tools {

/// Property of faces that has the number of their image, of several.
inline constexpr const char* kImageNumber = "texnumber";

/// Gives a mesh that has been read a material for each line `comment TextureFile NAME`; nothing
/// without such lines. Throws UserError(bad_input) for an image that cannot be read.
void take_ply_materials(const PlyFile& file, const FileScope& scope, PolygonMesh& mesh);

} // namespace geodisk::tools
