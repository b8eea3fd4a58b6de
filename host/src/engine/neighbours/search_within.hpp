// The search for all neighbours within given distances, by the disks of the sources.
#pragma once

#include <geodisk/neighbours.hpp>

namespace geodisk {

/// Returns a distance that is large enough for all edges of the mesh.
double shortest_distance(const PreparedMesh& mesh);

/// Implements find_neighbours() for a checked query with distances, but for joined vertices.
Result<Neighbours> search_within(Runner& runner, const PreparedMesh& mesh,
                                 const NeighbourQuery& query, const ProgressCallback& progress);

} // namespace geodisk
