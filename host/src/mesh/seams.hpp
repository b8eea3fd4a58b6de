// Borders that lie on each other, as where the vertices along a seam are doubled.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "geodisk/mesh.hpp"

namespace geodisk {

/// An edge by the vertices at its ends.
struct EdgeEnds {
    std::uint32_t from, to;
};

/// An edge that lies exactly on another one. Those in one place have the same `places`, and their
/// `from` lie in one place, as do their `to`.
struct CoincidingEdge {
    std::uint64_t places;
    std::uint32_t from, to;

    friend auto operator<=>(const CoincidingEdge&, const CoincidingEdge&) = default;
};

/// The edges of a single face. A face and its copies count as one.
std::vector<EdgeEnds> border_edges(const MeshView& mesh);

/// Those of `borders` with both ends exactly where those of another one are, sorted by place. Edges
/// with both ends in one place are points and coincide with nothing.
std::vector<CoincidingEdge> coinciding_edges(const MeshView& mesh,
                                             std::span<const EdgeEnds> borders);

} // namespace geodisk
