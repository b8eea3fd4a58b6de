// The search for all neighbours within given distances, by the disks of the sources.
#pragma once

#include <cstdint>
#include <span>

#include <geodisk/neighbours.hpp>

#include "engine/run/runner_impl.hpp"
#include "engine/run/task.hpp"

namespace geodisk {

/// Returns a distance that is large enough for all edges of the mesh.
double shortest_distance(const PreparedMesh& mesh);

/// Implements find_neighbours() for a checked query with distances, but for joined vertices.
/// Runner, mesh and query must outlive it. `whole`, if not empty, returns the progress of what the
/// search is a part of. If there are `bounds`, one for each vertex in mesh units, some points are
/// left out: those whose shortest path passes a vertex that is farther from the source than its
/// bound.
/// A mesh that the device cannot hold is searched in parts.
Task<Result<Neighbours>> search_within(Runner::Impl& runner, const PreparedMesh& mesh,
                                       const NeighbourQuery& query, WholeProgress whole = {},
                                       std::span<const double> bounds = {});

/// Searches all of the mesh at once. If the mesh is a part of a larger one, `frame` is the frame of
/// the jobs on that; else null.
Task<Result<Neighbours>> search_undivided(Runner::Impl& runner, const PreparedMesh& mesh,
                                          const NeighbourQuery& query, const JobFrame* frame,
                                          WholeProgress whole, std::span<const double> bounds);

/// Cuts the mesh into `parts` parts and searches one after another. `frame` is the frame of the
/// jobs on the whole mesh.
Task<Result<Neighbours>> search_in_parts(Runner::Impl& runner, const PreparedMesh& mesh,
                                         const NeighbourQuery& query, const JobFrame& frame,
                                         std::uint32_t parts, WholeProgress whole = {},
                                         std::span<const double> bounds = {});

} // namespace geodisk
