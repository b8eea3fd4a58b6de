// Wavefront OBJ: `v`, `f` and, where asked for, `vt` records; everything else in the file is
// ignored.
#pragma once

#include "common/polygon_mesh.hpp"

#include <filesystem>

namespace geodisk::tools {

/// Reads `path`. Understands every line end, line continuation, a byte order mark, relative
/// indices and faces of any size. Throws UserError(bad_input) naming the line.
PolygonMesh read_obj(const std::filesystem::path& path, bool has_uvs = false);

} // namespace geodisk::tools
