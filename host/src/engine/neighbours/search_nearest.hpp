// The search for the nearest neighbours, however far they are.
#pragma once

#include <geodisk/neighbours.hpp>

namespace geodisk {

/// Implements find_neighbours() for a checked query without distances, but for joined vertices: by
/// disks of ever larger radius, until each source has as many as it can have.
Result<Neighbours> search_nearest(Runner& runner, const PreparedMesh& mesh,
                                  const NeighbourQuery& query, const ProgressCallback& progress);

} // namespace geodisk
