// Checks of a search for neighbours, before it begins.
#pragma once

#include <cstdint>
#include <span>

#include <geodisk/mesh.hpp>
#include <geodisk/neighbours.hpp>
#include <geodisk/sample.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Checks vertices that are said to be joined. Errors name the first that is not so.
Result<Done> check_joined(const PreparedMesh& mesh, std::span<const std::uint32_t> joined);

/// Checks points of the mesh. Errors name the first that is none, as "source 3" if `name` is that.
Result<Done> check_points(const PreparedMesh& mesh, const char* name,
                          std::span<const Sample> points);

/// Checks all that a query asks for, but for edges that are too long for its distances.
Result<Done> check_query(const PreparedMesh& mesh, const NeighbourQuery& query);

/// Refuses distances in units of `unit` and up to `longest` that single precision cannot hold in
/// mesh units.
Result<Done> check_range(double unit, double longest);

} // namespace geodisk
