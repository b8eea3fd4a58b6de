// Joining the vertices of a mesh file that lie in one place.
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh.hpp"
#include "program/arguments.hpp"

namespace geodisk::tools {

/// Makes faces name the lowest one of all vertices no farther apart than `distance`, see
/// geodisk::weld(); of a length of 0, of those in exactly one place. Faces, vertices and what
/// belongs to them keep their numbers. `path` is for messages; throws UserError where
/// geodisk::weld() fails.
void weld_mesh(const std::string& path, MeshFile& mesh, const Length& distance);

/// Joins border edges that lie exactly on others, see geodisk::join_seams(). All else as
/// weld_mesh().
void join_mesh_seams(const std::string& path, MeshFile& mesh);

/// Returns values of the mesh's vertices, of those of the file: means for those that are joined,
/// and for copies what they are copies of have.
std::vector<double> values_at_vertices(const MeshFile& mesh, std::vector<double> values);

} // namespace geodisk::tools
