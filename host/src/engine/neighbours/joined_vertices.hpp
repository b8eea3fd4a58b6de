// Vertices that are joined, among neighbours.
#pragma once

#include <cstdint>
#include <span>

#include <geodisk/neighbours.hpp>

namespace geodisk {

/// Returns the query with the vertices that the mesh joined, if it names none itself.
inline NeighbourQuery with_joined(const PreparedMesh& mesh, NeighbourQuery query) {
    if (query.joined.empty()) {
        query.joined = mesh.joined_vertices();
    }
    return query;
}

/// Returns true if all vertices of a place are neighbours. The nearest ones are places, each by its
/// lowest vertex.
bool lists_joined(const NeighbourQuery& query);

/// Puts all vertices of a place where neighbours name the lowest one, sorted by index; `joined` as
/// for NeighbourQuery.
void name_joined(std::span<const std::uint32_t> joined, Neighbours& neighbours);

} // namespace geodisk
