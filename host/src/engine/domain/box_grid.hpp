// Grid of cells over a box, and the hash table that holds it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <geodisk/box.hpp>

#include "constants.h"
#include "records.h"

namespace geodisk {

static_assert(gpu::kMaxAxes == kMaxBoxDimensions);

/// Heads of a cell table per candidate; up to twice as many make a power of two. Sparser tables
/// cost memory, fuller ones make cells share a head.
inline constexpr std::uint64_t kHeadsPerCandidate = 2;

/// Shortest side as a part of a distance; a side is at least one step of this length.
inline constexpr double kShortestSide = 0x1p-31;

/// Returns the samples per D^n in a periodic box of n dimensions.
double density_in_box(std::size_t dimension) noexcept;

/// Returns the unit of lengths: the minimum distance, or an upper bound of all distances in the box
/// if that is smaller.
double unit_of(const BoxParams& box) noexcept;

/// Division of an axis of a box for drawing candidates, see host/docs/boxes.md.
struct DrawAxis {
    double step;         ///< Length of a step of a coordinate, in units of the sides.
    std::uint64_t steps; ///< Number of steps along the side, up to 2^32.
    std::uint32_t cells;
    std::uint32_t width; ///< Width of every cell but the last, in steps; 0 for 2^32.
    std::uint32_t last_width;
};
using DrawAxes = std::array<DrawAxis, gpu::kMaxAxes>;
DrawAxes draw_axes(const BoxParams& box) noexcept;
/// Returns axes with 2^32 steps along every side, whatever candidates are drawn by.
DrawAxes finest_axes(const BoxParams& box) noexcept;

/// Returns the stages of a box that pool_size() accepts, and the expected samples per unit of
/// volume.
Stages stages_of(const BoxParams& box) noexcept;
double samples_per_volume(const BoxParams& box) noexcept;

/// Computes the coordinates of a sample in a box with these draw_axes(), one per side.
void sample_point(std::uint64_t seed, const DrawAxes& axes, const gpu::SampleRec& sample,
                  std::span<double> point) noexcept;

/// Grid with cells at least half a distance wide. Its table has about as many heads as there are
/// cells, or candidates if those are fewer; see shaders/lib/grid.glsl.
struct BoxGrid {
    std::array<gpu::AxisRec, gpu::kMaxAxes> axes{};
    std::uint32_t heads; ///< Number of heads, a power of two.
    float limit2; ///< Squared distance below which candidates conflict, in units of the minimum
                  ///< distance.
    std::uint64_t draw_cells; ///< Number of cells for drawing candidates.

    /// Makes the grid of a `box` that pool_size() accepts. Coordinates are steps of `lattice`.
    /// Conflicts are tested against 1 + `guard` distances.
    BoxGrid(const BoxParams& box, const DrawAxes& lattice, std::uint32_t candidates, double guard);
};

} // namespace geodisk
