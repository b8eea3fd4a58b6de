// Vertices that are joined, among neighbours.
#pragma once

#include <cstdint>
#include <span>

#include <geodisk/neighbours.hpp>

namespace geodisk {

/// Puts all vertices of a place where neighbours name the lowest one; `joined` and `nearest` as for
/// NeighbourQuery.
void name_joined(std::span<const std::uint32_t> joined, std::uint32_t nearest,
                 Neighbours& neighbours);

} // namespace geodisk
