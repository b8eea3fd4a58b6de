// Joining the vertices of a mesh file that lie in one place.
#pragma once

#include <string>

#include "geometry/mesh.hpp"
#include "program/arguments.hpp"

namespace geodisk::tools {

/// Makes faces name the lowest one of all vertices no farther apart than `distance`, see
/// geodisk::weld(); of a length of 0, of those in exactly one place. Faces, vertices and what
/// belongs to them keep their numbers. `path` is for messages; throws UserError where
/// geodisk::weld() fails.
void weld_mesh(const std::string& path, MeshFile& mesh, const Length& distance);

} // namespace geodisk::tools
