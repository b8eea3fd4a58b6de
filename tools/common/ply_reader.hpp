// Triangle meshes from PLY files.
#pragma once

#include "common/polygon_mesh.hpp"

#include <filesystem>
#include <span>
#include <string>

namespace geodisk::tools {

/// What to read of element `vertex`.
struct PlyWanted {
    bool has_coordinates = true;             ///< False: if it has no coordinates, do without.
    std::span<const std::string> attributes; ///< Names of scalar properties.
    bool has_uvs = false; ///< Texture coordinates: s t, u v or texture_u texture_v.
};

/// Reads the coordinates of element `vertex`, which are x0 x1 ..., 3 to 8 of them, where there is
/// an x0, and x y z otherwise, and the list `vertex_indices` or `vertex_index` of element `face`,
/// in any format, type and order; everything else is skipped. Throws UserError(bad_input) naming
/// the element and record.
PolygonMesh read_ply(const std::filesystem::path& path, const PlyWanted& wanted);

} // namespace geodisk::tools
