// The search for the nearest neighbours.
#pragma once

#include <geodisk/neighbours.hpp>

#include "engine/run/runner_impl.hpp"
#include "engine/run/task.hpp"

namespace geodisk {

/// Implements find_neighbours() for a checked query of nearest neighbours, but for joined vertices:
/// by disks of ever larger radius, until each source has as many as it can have. Runner, mesh and
/// query must outlive it.
Task<Result<Neighbours>> search_nearest(Runner::Impl& runner, const PreparedMesh& mesh,
                                        const NeighbourQuery& query);

} // namespace geodisk
