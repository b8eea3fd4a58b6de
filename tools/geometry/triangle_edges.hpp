// The edges of triangles, by number.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace geodisk::tools {

/// Returns true for a triangle that names three vertices.
inline bool names_three(const std::uint32_t* v) {
    return v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
}

/// The edges of all triangles that name three vertices: the number of each, and the triangles on
/// it.
struct TriangleEdges {
    explicit TriangleEdges(const std::vector<std::uint32_t>& triangles);

    /// Returns the corners from which an edge leads to the next corner of their triangles,
    /// ascending.
    std::span<const std::uint32_t> on(std::uint32_t edge) const {
        return std::span(corners).subspan(starts[edge], starts[edge + 1] - starts[edge]);
    }

    std::vector<std::uint32_t> of_corner;           ///< Edge from each corner to the next.
    std::vector<std::array<std::uint32_t, 2>> ends; ///< Vertices of each edge, the lower first.
    std::vector<std::size_t> starts;
    std::vector<std::uint32_t> corners; ///< Corners where the edges of triangles begin, by edge.
};

} // namespace geodisk::tools
