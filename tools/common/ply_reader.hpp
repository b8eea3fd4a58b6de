// Triangle meshes from PLY files.
#pragma once

#include "common/polygon_mesh.hpp"

#include <filesystem>

namespace geodisk::tools {

/// Reads x y z of element `vertex` and the list `vertex_indices` or `vertex_index` of element
/// `face`, in any format, type and order; everything else is skipped. Throws UserError(bad_input)
/// naming the element and record.
PolygonMesh read_ply(const std::filesystem::path& path);

} // namespace geodisk::tools
