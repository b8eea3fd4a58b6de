// Twin of shaders/kernels/scan_*.comp and bin_fill.comp: candidates sorted by face and cell.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/surface.hpp"

namespace geodisk::ref {

/// Square cells over a face, Surface::cells_per_unit() to the unit (two to the minimum distance
/// where radii do not vary), in the frame of its longest edge. A face whose longest edge is shorter
/// than a cell has just one.
struct Grid {
    std::uint32_t columns, rows;
    std::uint32_t base; ///< Half-edge whose frame the grid lies in.
    bool single() const { return columns == 1 && rows == 1; }
};

template <class Real>
Grid face_grid(const Surface<Real>& surface, std::uint32_t face);

/// Position of a point of half-edge h's face in the frame of h.
template <class Real>
struct Position {
    Real x, y;
};
template <class Real>
Position<Real> position_in(const Surface<Real>& surface, std::uint32_t h, FacePoint<Real> point);

/// Points sorted by cell. `order[starts[c] .. starts[c + 1])` are the points of cell c, in rank
/// order; the cells of face f begin at `first_cell[f]`, row by row.
template <class Real>
struct Bins {
    std::vector<std::uint32_t> first_cell; ///< One more than faces.
    std::vector<std::uint32_t> starts;     ///< One more than cells.
    std::vector<std::uint32_t> order;
    std::vector<FacePoint<Real>> points; ///< In the order of `order`.

    Bins(const Surface<Real>& surface, std::span<const FacePoint<Real>> by_rank);
};

} // namespace geodisk::ref
