// Reads triangle meshes from OBJ and PLY files, and from the built-in generators.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace geodisk::tools {

/// A mesh as read: `positions` holds x y z per vertex, `triangles` three vertex indices each, in
/// file order with polygons split in place (so triangle i of the file's n-th face follows all
/// triangles of earlier faces). Vertices are those of the file, in its order, also the unused.
struct MeshFile {
    std::vector<double> positions;
    std::vector<std::uint32_t> triangles;
    std::uint32_t dimension = 3;
    std::vector<std::string>
        warnings; ///< One line each: what was repaired or ignored, with counts.
};

/// Reads `path`: `*.obj`, `*.ply` (case-insensitive extension) or `builtin:NAME[:RESOLUTION]`.
///
/// Every index is in range, every used vertex is finite, at least one triangle has an area, and no
/// triangle repeats a vertex or is a copy of an earlier one: such faces are dropped with a warning.
/// Triangles without area are kept, as paths may lead through them.
///
/// Throws UserError(bad_input) that names the file, the cause, and the line or element;
/// UserError(usage) for an unknown built-in name or resolution.
MeshFile read_mesh(const std::string& path);

} // namespace geodisk::tools
