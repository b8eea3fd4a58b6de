// Twin of shaders/kernels/grid_detect.comp: disks in boxes of R^n by a grid of cells.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "constants.h"
#include "geodisk/box.hpp"
#include "kernels/box_candidates.hpp"
#include "kernels/curve.hpp"

namespace geodisk::ref {

template <class Real>
struct GridAxis {
    std::uint32_t cells, stride;
    Real unit, width;       ///< Length of a step and width of a cell, in minimum distances.
    std::uint32_t per_step; ///< Cells per step of the lattice, in units of 2^-32.

    std::uint32_t cell_of(std::uint32_t coordinate) const {
        return static_cast<std::uint32_t>(std::uint64_t{coordinate} * per_step >> 32);
    }
    /// Returns the position of a coordinate in its cell, as a part of the width, rounded down.
    Real inside_of(std::uint32_t coordinate) const {
        const auto part = static_cast<std::uint32_t>(std::uint64_t{coordinate} * per_step);
        return static_cast<Real>(part >> 8) * static_cast<Real>(0x1p-24);
    }
};

/// Grid over a box with cells slightly wider than half the minimum distance, in a table of heads.
template <class Real>
struct BoxCellTable {
    std::vector<GridAxis<Real>> axes;
    bool is_periodic;
    std::uint32_t heads;
    Real limit2;

    BoxCellTable(const BoxLattice& lattice, std::size_t candidates, double guard);
    std::uint32_t head_of(const BoxPoint& point) const;
};

/// Candidates sorted by head: those of head h are at the places starts[h] to starts[h + 1].
template <class Real>
struct BoxPool {
    BoxCellTable<Real> table;
    std::vector<std::uint32_t> starts;
    std::vector<BoxPoint> points;      ///< Points by place.
    std::vector<std::uint32_t> order;  ///< Ranks by place.
    std::vector<std::uint32_t> places; ///< Places by rank.
    /// Normals by place; with them, distances are lengths of curves.
    std::vector<std::array<Real, 3>> normals;

    /// Draws the candidates of a job.
    explicit BoxPool(const BoxParams& box);
    /// Takes points of a lattice. The table is sized for this many candidates, or if 0 for the
    /// points.
    BoxPool(const BoxLattice& lattice, std::span<const BoxPoint> by_rank, double guard,
            std::size_t capacity = 0);

    std::uint32_t size() const { return static_cast<std::uint32_t>(places.size()); }
    void set_normals(std::span<const std::array<float, 3>> by_rank);
};

struct BoxDiskCount {
    std::uint32_t rows = 0, tested = 0;
};

/// Calls `hit(place)` for each candidate with `wanted(place)` in the disk of another: once, or more
/// often if cells share a head.
template <class Real>
class BoxDetector {
  public:
    explicit BoxDetector(const BoxPool<Real>& pool) : pool_(pool) {}

    template <class Wanted, class Hit>
    BoxDiskCount run(std::uint32_t place, Wanted&& wanted, Hit&& hit);

  private:
    static constexpr Real kFar = 0x1p30;
    static constexpr Real kPadding = 0x1p-20;

    bool takes_all(const GridAxis<Real>& axis) const {
        return pool_.table.is_periodic && axis.cells < gpu::kGridDigits;
    }
    Real gap_to(std::size_t axis, std::uint32_t digit) const;
    std::uint32_t cell_at(std::size_t axis, std::uint32_t digit) const;
    Real square_to(const BoxPoint& other) const;
    bool conflicts_with(std::uint32_t other) const;
    template <class Visit>
    void visit_rows(std::size_t axis, Real sum, std::uint32_t head, Visit& visit) const;

    const BoxPool<Real>& pool_;
    std::uint32_t own_place_ = 0;
    BoxPoint own_{};
    std::array<std::uint32_t, gpu::kMaxAxes> own_cell_{};
    std::array<Real, gpu::kMaxAxes> own_inside_{};
};

/// Throws darts sequentially over the pool, until it is used up or `most` are accepted. Returns
/// their ranks, ascending.
template <class Real>
std::vector<std::uint32_t> throw_darts(const BoxPool<Real>& pool,
                                       std::uint32_t most = kMaxCandidates);

template <class Real>
Real BoxDetector<Real>::gap_to(std::size_t axis, std::uint32_t digit) const {
    const GridAxis<Real>& a = pool_.table.axes[axis];
    if (takes_all(a)) {
        return digit < a.cells ? Real{0} : kFar;
    }
    const auto offset = static_cast<std::int32_t>(digit - gpu::kGridReach);
    const std::int64_t cell = std::int64_t{own_cell_[axis]} + offset;
    if (!pool_.table.is_periodic && (cell < 0 || cell >= a.cells)) {
        return kFar;
    }
    if (offset == 0) {
        return 0;
    }
    const Real cells = offset > 0 ? static_cast<Real>(offset) - own_inside_[axis]
                                  : static_cast<Real>(-offset - 1) + own_inside_[axis];
    const Real gap = cells * a.width - kPadding;
    return gap < 0 ? Real{0} : gap;
}

template <class Real>
std::uint32_t BoxDetector<Real>::cell_at(std::size_t axis, std::uint32_t digit) const {
    const GridAxis<Real>& a = pool_.table.axes[axis];
    if (takes_all(a)) {
        return digit;
    }
    const std::uint64_t cell = std::uint64_t{own_cell_[axis]} + digit + a.cells - gpu::kGridReach;
    return static_cast<std::uint32_t>(cell % a.cells);
}

template <class Real>
Real BoxDetector<Real>::square_to(const BoxPoint& other) const {
    Real sum = 0;
    for (std::size_t i = 0; i < pool_.table.axes.size(); ++i) {
        const std::uint32_t ahead = other[i] - own_[i];
        const std::uint32_t back = own_[i] - other[i];
        const std::uint32_t steps = pool_.table.is_periodic ? std::min(ahead, back)
                                    : other[i] < own_[i]    ? back
                                                            : ahead;
        const Real along = static_cast<Real>(steps) * pool_.table.axes[i].unit;
        sum = sum + along * along;
    }
    return sum;
}

template <class Real>
bool BoxDetector<Real>::conflicts_with(std::uint32_t other) const {
    const BoxPoint& point = pool_.points[other];
    const Real square = square_to(point);
    if (pool_.normals.empty() || square >= pool_.table.limit2) {
        return square < pool_.table.limit2;
    }
    std::array<Real, 3> way;
    for (std::size_t i = 0; i < 3; ++i) {
        const bool is_back = point[i] < own_[i];
        const Real along = static_cast<Real>(is_back ? own_[i] - point[i] : point[i] - own_[i]) *
                           pool_.table.axes[i].unit;
        way[i] = is_back ? -along : along;
    }
    return is_short_curve(way, square, pool_.normals[own_place_], pool_.normals[other],
                          pool_.table.limit2);
}

/// Visits axes from the last to the second, then rows.
template <class Real>
template <class Visit>
void BoxDetector<Real>::visit_rows(std::size_t axis, Real sum, std::uint32_t head,
                                   Visit& visit) const {
    const Real limit2 = pool_.table.limit2;
    for (std::uint32_t digit = 0; digit < gpu::kGridDigits; ++digit) {
        const Real gap = gap_to(axis, digit);
        const Real next = sum + gap * gap;
        if (next >= limit2) {
            continue;
        }
        const std::uint32_t cell = cell_at(axis, digit);
        if (axis > 0) {
            visit_rows(axis - 1, next, head + cell * pool_.table.axes[axis].stride, visit);
            continue;
        }
        visit(cell, (head + cell) & (pool_.table.heads - 1));
    }
}

template <class Real>
template <class Wanted, class Hit>
BoxDiskCount BoxDetector<Real>::run(std::uint32_t place, Wanted&& wanted, Hit&& hit) {
    own_place_ = place;
    own_ = pool_.points[place];
    for (std::size_t i = 0; i < pool_.table.axes.size(); ++i) {
        const GridAxis<Real>& axis = pool_.table.axes[i];
        own_cell_[i] = axis.cell_of(own_[i]);
        own_inside_[i] = axis.inside_of(own_[i]);
    }
    BoxDiskCount count;
    std::uint32_t next_cell = 0;
    std::uint32_t next_head = 0;
    auto visit = [&](std::uint32_t cell, std::uint32_t head) {
        // Cells of a row with consecutive heads make one visit.
        const bool goes_on = count.rows > 0 && cell == next_cell && head == next_head;
        count.rows += goes_on ? 0 : 1;
        next_cell = cell + 1;
        next_head = head + 1;
        const std::uint32_t end = pool_.starts[std::size_t{head} + 1];
        for (std::uint32_t other = pool_.starts[head]; other < end; ++other) {
            if (other == place || !wanted(other)) {
                continue;
            }
            ++count.tested;
            if (conflicts_with(other)) {
                hit(other);
            }
        }
    };
    visit_rows(pool_.table.axes.size() - 1, 0, 0, visit);
    return count;
}

} // namespace geodisk::ref
