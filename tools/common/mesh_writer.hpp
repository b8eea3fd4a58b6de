// Writes triangle meshes to PLY files.
#pragma once

#include "common/mesh_file.hpp"

#include <filesystem>

namespace geodisk::tools {

/// Writes positions and triangles as binary PLY that reads back exactly: element vertex with double
/// x y z, and beyond three dimensions also x0 x1 ..., of which x y z repeat the first three so that
/// viewers show them; element face with vertex_indices. The file appears complete or not at all.
/// Throws UserError(usage) for another extension, UserError(bad_output) when it cannot be written.
void write_mesh(const std::filesystem::path& path, const MeshFile& mesh);

} // namespace geodisk::tools
