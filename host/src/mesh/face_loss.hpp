// Tells without welding that weld() removes no face.
#pragma once

#include "geodisk/mesh_view.hpp"

namespace geodisk {

/// Returns true only if weld() with `epsilon`, which is positive, certainly joins no two corners of
/// a face. Takes a time linear in the mesh. False says nothing.
bool keeps_all_faces(const MeshView& mesh, double epsilon);

} // namespace geodisk
