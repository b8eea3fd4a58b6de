// Warnings about a mesh once its faces are connected.
#pragma once

#include <vector>

#include <geodisk/mesh.hpp>

#include "geometry/mesh.hpp"

namespace geodisk::tools {

/// Tells of edges of three or more faces, vertices that join parts without a common edge, faces
/// turned over against their neighbours, several components, open seams, seams with a gap, and, of
/// edge lengths, of faces without area. `has_normals` says that vertices are lifted by their
/// normals.
std::vector<MeshWarning> surface_warnings(const MeshFile& file, const PreparedMesh& mesh,
                                          bool has_normals = false);

/// Adds a warning where border edges nearly coincide with others, see geodisk::find_near_seams().
void warn_of_near_seams(const MeshView& view, const MeshStatistics& statistics,
                        std::vector<MeshWarning>& warnings);

} // namespace geodisk::tools
