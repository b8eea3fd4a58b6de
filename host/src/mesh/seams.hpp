// Borders that coincide, for example where the vertices along a seam are duplicated.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "geodisk/mesh.hpp"

namespace geodisk {

/// The vertices at the ends of an edge.
struct EdgeEnds {
    std::uint32_t from, to;
};

/// An edge that coincides exactly with another one. Edges at the same place have the same `places`.
/// Their `from` vertices are at one position, and so are their `to` vertices.
struct CoincidingEdge {
    std::uint64_t places;
    std::uint32_t from, to;

    friend auto operator<=>(const CoincidingEdge&, const CoincidingEdge&) = default;
};

/// Returns the edges of a single face. A face and its copies count as one.
std::vector<EdgeEnds> border_edges(const MeshView& mesh);
/// Returns them for a mesh whose half-edges are connected already.
std::vector<EdgeEnds> border_edges(const MeshView& mesh, std::span<const HalfEdge> half_edges);

/// Returns those of `borders` that coincide with another one at both ends, sorted by place. Edges
/// with both ends at one position are points and coincide with nothing.
std::vector<CoincidingEdge> coinciding_edges(const MeshView& mesh,
                                             std::span<const EdgeEnds> borders);

} // namespace geodisk
