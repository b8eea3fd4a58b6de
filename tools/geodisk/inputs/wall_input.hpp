// The walls of a mesh, by the options of a command.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geodisk/options/wall_options.hpp"
#include "geometry/mesh.hpp"

namespace geodisk::tools {

/// Cuts the mesh at `path` along walls, see geodisk::cut(): triangles that are walls take no part
/// then, and vertices on both sides of walls of edges are copied behind those of the file. The mesh
/// must have been read with the properties and texture coordinates of the rules.
///
/// Throws UserError(bad_input) for a part that the mesh does not have, for walls that are nowhere,
/// for those that leave no face, and for what is wrong in a file of edges.
void cut_walls(const std::string& path, const std::vector<WallRule>& walls, MeshFile& mesh);

} // namespace geodisk::tools
