// Vertices that are joined, among neighbours.
#pragma once

#include <cstdint>
#include <span>

#include <geodisk/neighbours.hpp>

namespace geodisk {

/// Returns true if all vertices of a place are neighbours. The nearest ones are places, each by its
/// lowest vertex.
bool lists_joined(const NeighbourQuery& query);

/// Puts all vertices of a place where neighbours name the lowest one, sorted by index; `joined` as
/// for NeighbourQuery.
void name_joined(std::span<const std::uint32_t> joined, Neighbours& neighbours);

} // namespace geodisk
