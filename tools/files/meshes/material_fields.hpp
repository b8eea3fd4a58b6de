// The colours of materials, from the readers of mesh files to the triangles that have them.
#pragma once

#include "geometry/mesh.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

struct PolygonMesh;

/// Moves the colours of materials into `mesh`, which has its parts and texture coordinates already.
/// Warns of faces without material, and of those with an image but no texture coordinates.
/// Throws UserError(bad_input) if the file has no materials.
void take_materials(const Path& path, PolygonMesh& polygons, MeshFile& mesh);

} // namespace geodisk::tools
