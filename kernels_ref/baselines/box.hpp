// Boxes of R^n, and points in them sorted into cells.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace geodisk::ref {

inline constexpr std::uint32_t kMaxDimensions = 6;

/// The box [0, sides[0]) x [0, sides[1]) x ..., with 1 to kMaxDimensions sides, each positive.
struct Box {
    std::vector<double> sides;
    bool is_periodic = false; ///< Opposite sides are glued together.

    std::uint32_t dimension() const { return static_cast<std::uint32_t>(sides.size()); }
    double volume() const;

    /// Returns the squared distance of two points, around the box if it is periodic.
    double distance2(std::span<const double> a, std::span<const double> b) const;
};

/// Cells of a box, each at least `reach` wide, so that everything within `reach` of a point is in
/// the 3^n cells around it. There are at most 2^24 of them, so they may be wider.
class BoxCells {
  public:
    BoxCells(const Box& box, double reach);

    std::uint32_t count() const { return count_; }
    std::uint32_t cell_of(std::span<const double> point) const;

    /// Calls `visit(cell)` once for each cell around the point, until it returns false.
    template <class Visit>
    void for_around(std::span<const double> point, Visit&& visit) const;

  private:
    std::uint32_t place_on(std::size_t axis, double x) const;

    /// Cells along one axis to visit.
    struct Places {
        std::array<std::uint32_t, 3> at{};
        std::size_t count = 0;
    };
    Places places_around(std::size_t axis, double x) const;

    bool is_periodic_;
    std::size_t axes_;
    std::array<std::uint32_t, kMaxDimensions> counts_{};
    std::array<double, kMaxDimensions> per_length_{};
    std::uint32_t count_ = 1;
};

/// A growing set of points, with queries for those closer than `distance` to another point.
class BoxGrid {
  public:
    BoxGrid(const Box& box, double distance);

    /// Adds a point in the box, with one coordinate per side.
    void add(std::span<const double> point);

    const Box& box() const { return box_; }
    std::uint32_t size() const { return static_cast<std::uint32_t>(next_.size()); }
    std::span<const double> point(std::uint32_t index) const {
        return std::span(coordinates_)
            .subspan(std::size_t{index} * box_.dimension(), box_.dimension());
    }
    const std::vector<double>& coordinates() const { return coordinates_; }

    /// Calls `visit(index)` for each point closer than the distance, until it returns false.
    template <class Visit>
    void for_near(std::span<const double> at, Visit&& visit) const;

    /// Returns true if no point is closer than the distance.
    bool is_free(std::span<const double> at) const;

  private:
    static constexpr std::uint32_t kNone = ~0u;

    Box box_;
    double distance2_;
    BoxCells cells_;
    std::vector<std::uint32_t> first_; ///< Last point added to each cell.
    std::vector<std::uint32_t> next_;  ///< For each point, the one added to its cell before it.
    std::vector<double> coordinates_;
};

/// Visits the points of `pool` and accepts each that has no accepted one closer than
/// `min_distance`. Returns the coordinates of those, in this order.
std::vector<double> throw_in_order(const Box& box, double min_distance,
                                   std::span<const double> pool);

template <class Visit>
void BoxCells::for_around(std::span<const double> point, Visit&& visit) const {
    std::array<Places, kMaxDimensions> places;
    for (std::size_t axis = 0; axis < axes_; ++axis) {
        places[axis] = places_around(axis, point[axis]);
    }
    std::array<std::size_t, kMaxDimensions> turn{};
    for (;;) {
        std::uint32_t cell = 0;
        for (std::size_t axis = 0; axis < axes_; ++axis) {
            cell = cell * counts_[axis] + places[axis].at[turn[axis]];
        }
        if (!visit(cell)) {
            return;
        }
        std::size_t axis = axes_;
        while (axis > 0 && ++turn[axis - 1] == places[axis - 1].count) {
            turn[--axis] = 0;
        }
        if (axis == 0) {
            return;
        }
    }
}

template <class Visit>
void BoxGrid::for_near(std::span<const double> at, Visit&& visit) const {
    cells_.for_around(at, [&](std::uint32_t cell) {
        for (std::uint32_t i = first_[cell]; i != kNone; i = next_[i]) {
            if (box_.distance2(at, point(i)) < distance2_ && !visit(i)) {
                return false;
            }
        }
        return true;
    });
}

} // namespace geodisk::ref
