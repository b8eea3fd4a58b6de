// The intrinsic geometry of faces: lengths, apexes and corner angles, from coordinates or
// from the lengths of edges.
#pragma once

#include <span>
#include <vector>

#include "geodisk/mesh.hpp"
#include "mesh/connectivity.hpp"

namespace geodisk {

/// Appends the half-edges of all faces to `half_edges`, with everything that the face alone
/// determines, and their links, each alone, to `links`; returns the faces' areas and adds up
/// `area`, `longest_edge`, `triangles`, `zero_area_faces` and `repeated_index_faces`.
///
/// A face that names a vertex twice gets neither lengths nor area: its sides must neither widen the
/// tolerances nor take cells. The mesh must have passed check_mesh().
std::vector<double> place_faces(const MeshView& mesh, std::vector<HalfEdge>& half_edges,
                                std::vector<Link>& links, MeshStatistics& statistics);
std::vector<double> place_faces(const LengthMeshView& mesh, std::vector<HalfEdge>& half_edges,
                                std::vector<Link>& links, MeshStatistics& statistics);

} // namespace geodisk
