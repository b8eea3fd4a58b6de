// Reads triangle meshes from OBJ and PLY files, and from the built-in generators.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace geodisk::tools {

/// A mesh as read: `positions` holds x y z per vertex, `triangles` three vertex indices each, in
/// file order with polygons split in place (so triangle i of the file's n-th face follows all
/// triangles of earlier faces).
struct MeshFile {
    std::vector<double> positions;
    std::vector<std::uint32_t> triangles;
    std::vector<std::string> warnings; ///< One line each: what was repaired or ignored, with counts.
};

/// Reads `path`: `*.obj`, `*.ply` (case-insensitive extension) or `builtin:NAME[:RESOLUTION]`.
/// Throws UserError(bad_input) that names the file, the cause, and the line or element.
MeshFile read_mesh(const std::string& path);

} // namespace geodisk::tools
