// The extensions that a glTF file requires.
#pragma once

#include <vector>

#include "files/meshes/gltf_json.hpp"
#include "geometry/mesh_warning.hpp"

namespace geodisk::tools {

/// Warns of required extensions that are ignored. Throws UserError(bad_input) for one that may
/// change the surface and is not read. Those of materials are read if `has_materials`.
void check_required_extensions(const GltfDocument& document, bool has_materials,
                               std::vector<MeshWarning>& warnings);

} // namespace geodisk::tools
