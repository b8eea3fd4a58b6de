// The intrinsic geometry of faces: lengths, apexes and corner angles, from coordinates or
// from the lengths of edges.
#pragma once

#include <span>

#include "geodisk/mesh.hpp"
#include "geodisk/uninitialized.hpp"
#include "mesh/connectivity.hpp"

namespace geodisk {

/// Fills `half_edges` with the half-edges of all faces and everything that the face alone
/// determines, and `links` with their links, each alone; adds up `area`, `longest_edge`,
/// `triangles`, `zero_area_faces` and `repeated_index_faces`.
///
/// A face that names a vertex twice gets neither lengths nor area: its sides must neither widen the
/// tolerances nor take cells. The mesh must have passed check_mesh().
void place_faces(const ThreadOptions& threads, const MeshView& mesh,
                 UninitializedVector<HalfEdge>& half_edges, UninitializedVector<Link>& links,
                 MeshStatistics& statistics);
void place_faces(const ThreadOptions& threads, const LengthMeshView& mesh,
                 UninitializedVector<HalfEdge>& half_edges, UninitializedVector<Link>& links,
                 MeshStatistics& statistics);

/// Adds a face to the statistics of its block of faces. Returns its area.
double add_face(bool takes_part, const HalfEdge (&edges)[3], MeshStatistics& block);

/// Adds up what add_face() said of all faces; areas in their order, so that the sum is always the
/// same.
void sum_up(std::span<const double> areas, std::span<const MeshStatistics> blocks,
            MeshStatistics& statistics);

} // namespace geodisk
