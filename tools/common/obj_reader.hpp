// Wavefront OBJ: `v` and `f` records; everything else in the file is ignored.
#pragma once

#include "common/polygon_mesh.hpp"

#include <filesystem>

namespace geodisk::tools {

/// Reads `path`. Understands every line end, line continuation, a byte order mark, relative
/// indices and faces of any size. Throws UserError(bad_input) naming the line.
PolygonMesh read_obj(const std::filesystem::path& path);

} // namespace geodisk::tools
