// The intrinsic geometry of faces: lengths, apexes and corner angles, from coordinates.
#pragma once

#include <span>
#include <vector>

#include "geodisk/mesh.hpp"
#include "mesh/connectivity.hpp"

namespace geodisk {

/// Appends the half-edges of all faces to `half_edges`, with everything that the face alone
/// determines, and their links, each alone, to `links`; returns the faces' areas and adds up
/// `area`, `longest_edge`, `zero_area_faces` and `repeated_index_faces`.
///
/// A face that names a vertex twice gets neither lengths nor area: its sides must neither widen the
/// tolerances nor take cells. Indices must be in range and coordinates finite.
std::vector<double> place_faces(const MeshView& mesh, std::vector<HalfEdge>& half_edges,
                                std::vector<Link>& links, MeshStatistics& statistics);

} // namespace geodisk
