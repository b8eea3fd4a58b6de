// Points sorted by face and cell, for detect.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "geodisk/detail/uninitialized.hpp"
#include "lib/surface.hpp"

namespace geodisk::ref {

/// Square cells over a face, in the frame of its longest edge, Surface::cells_per_unit() per unit
/// (two per minimum distance if radii do not vary). A face whose longest edge is shorter than a
/// cell has one cell.
struct Grid {
    std::uint32_t columns, rows;
    std::uint32_t base;           ///< Half-edge whose frame the grid uses.
    std::uint32_t first_cell = 0; ///< Number of the first cell in Bins.

    std::uint32_t cells() const { return columns * rows; }
    bool single() const { return columns == 1 && rows == 1; }
};

/// Returns the position of a point of half-edge h's face in the frame of h.
template <class Real>
struct Position {
    Real x, y;
};
template <class Real>
Position<Real> position_in(const Surface<Real>& surface, std::uint32_t h, FacePoint<Real> point) {
    const Edge<Real>& edge = surface.edges[h];
    const Real weights[3] = {Real{1} - point.weight1 - point.weight2, point.weight1, point.weight2};
    const std::uint32_t k = h % 3;
    const Real end = weights[(k + 1) % 3];
    const Real apex = weights[(k + 2) % 3];
    return {end * edge.length + apex * edge.apex_x, apex * edge.apex_y};
}

/// Converts a point from the frame of h to that of `base`, a half-edge of the same face.
template <class Real>
Position<Real> in_other_frame(const Surface<Real>& surface, std::uint32_t h, std::uint32_t base,
                              Position<Real> at) {
    const Edge<Real>& b = surface.edges[base];
    if (h == base) {
        return at;
    }
    if (h == next_in_face(base)) {
        const Edge<Real>& e = surface.edges[h];
        return {b.length - at.x * e.cosine - at.y * e.sine, at.x * e.sine - at.y * e.cosine};
    }
    return {b.apex_x - at.x * b.cosine + at.y * b.sine, b.apex_y - at.x * b.sine - at.y * b.cosine};
}

/// Returns the cell of a point in the grid of its face.
template <class Real>
std::uint32_t cell_of(const Surface<Real>& surface, const Grid& grid, FacePoint<Real> point) {
    if (grid.single()) {
        return 0;
    }
    const auto at = position_in(surface, grid.base, point);
    const Real per_unit = surface.cells_per_unit(point.face);
    const auto index = [per_unit](Real x, std::uint32_t count) {
        const Real scaled = x * per_unit;
        return scaled <= 0 ? 0 : std::min(static_cast<std::uint32_t>(scaled), count - 1);
    };
    return index(at.y, grid.rows) * grid.columns + index(at.x, grid.columns);
}

/// Points sorted by cell. `order[starts[c] .. starts[c + 1])` are the points of cell c; the cells
/// of face f begin at `grids[f].first_cell`, row by row.
template <class Real>
struct Bins {
    std::vector<Grid> grids;           ///< Grid of each face.
    std::vector<std::uint32_t> starts; ///< First index of each cell, and the end.
    std::vector<std::uint32_t> order;  ///< Index of each point; empty in a Pool, which lists its
                                       ///< places.
    UninitializedVector<FacePoint<Real>> points; ///< Points by place, in the order of `order`.

    Bins() = default;
    /// Sorts points by cell; points of a cell keep their order.
    Bins(const Surface<Real>& surface, std::span<const FacePoint<Real>> given);

    /// Makes a grid for each face; returns the number of cells.
    std::size_t lay_out(const Surface<Real>& surface);
};

} // namespace geodisk::ref
