// The files that a mesh file names: buffers, images, materials and textures.
#pragma once

#include <string>
#include <vector>

#include "program/path.hpp"

namespace geodisk::tools {

/// Returns the paths of all files that `path` names, and the files that these name, whether geodisk
/// reads them or not: `uri` of glTF, `mtllib` of OBJ with the textures of its materials, and the
/// textures that MeshLab notes in PLY. A name that may be understood in several ways gives several
/// paths; those of nothing are left out. `format` stands in for the extension unless it is "".
/// Streams, whose names are refused, and files that cannot be read name none.
std::vector<Path> files_named_in(const Path& path, const std::string& format = {});

} // namespace geodisk::tools
