// Intrinsic geometry of faces (lengths, apexes, corner angles) from coordinates or edge lengths.
#pragma once

#include <span>

#include "geodisk/detail/uninitialized.hpp"
#include "geodisk/mesh.hpp"
#include "mesh/connectivity.hpp"

namespace geodisk {

/// Fills in everything that a face alone determines: its half-edges, and their links, each alone.
/// Adds to `area`, `longest_edge`, `triangles`, `zero_area_faces` and `repeated_index_faces`.
///
/// A face that names a vertex twice gets no lengths and no area, so that it neither widens
/// tolerances nor gets cells. The mesh must have passed check_mesh().
void place_faces(const ThreadOptions& threads, const MeshView& mesh,
                 UninitializedVector<HalfEdge>& half_edges, UninitializedVector<Link>& links,
                 MeshStatistics& statistics);
void place_faces(const ThreadOptions& threads, const LengthMeshView& mesh,
                 UninitializedVector<HalfEdge>& half_edges, UninitializedVector<Link>& links,
                 MeshStatistics& statistics);

/// Adds a face to the statistics of its block of faces. Returns its area.
double add_face(bool takes_part, const HalfEdge (&edges)[3], MeshStatistics& block);

/// Sums up the results of add_face() for all faces. Areas are added in their order, so that the sum
/// is always the same.
void sum_up(std::span<const double> areas, std::span<const MeshStatistics> blocks,
            MeshStatistics& statistics);

} // namespace geodisk
