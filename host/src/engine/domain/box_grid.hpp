// The grid of cells over a box, and the hash table that holds it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <geodisk/box.hpp>

#include "constants.h"
#include "records.h"

namespace geodisk {

static_assert(gpu::kMostAxes == kMostBoxDimensions);

/// Heads of a table of cells, in proportion; up to twice as many make a power of two. Sparser
/// tables cost memory, fuller ones make cells share a head.
inline constexpr std::uint64_t kHeadsPerCandidate = 2;

/// Of a distance: a side is at least one step of this length.
inline constexpr double kShortestSide = 0x1p-31;

/// Samples per D^n in a periodic box of n dimensions.
double density_in_box(std::size_t dimension) noexcept;

/// The least distance that all others in the box are below, or the minimum distance where that is
/// smaller: the unit of lengths.
double unit_of(const BoxParams& box) noexcept;

/// How an axis of a box is divided for drawing candidates: see host/docs/boxes.md.
struct DrawAxis {
    double step;         ///< Of a coordinate, in the units of the sides.
    std::uint64_t steps; ///< Along the whole side, up to 2^32.
    std::uint32_t cells;
    std::uint32_t width; ///< Of a cell but the last, in steps; 0 for 2^32.
    std::uint32_t last_width;
};
using DrawAxes = std::array<DrawAxis, gpu::kMostAxes>;
DrawAxes draw_axes(const BoxParams& box) noexcept;
/// 2^32 steps along every side, whatever the candidates are drawn by.
DrawAxes finest_axes(const BoxParams& box) noexcept;

/// The stages of a box that pool_size() finds no fault with, and the samples that are expected per
/// unit of volume.
Stages stages_of(const BoxParams& box) noexcept;
double samples_per_volume(const BoxParams& box) noexcept;

/// The coordinates of a sample of a box whose draw_axes() these are; as many as the box has sides.
void sample_point(std::uint64_t seed, const DrawAxes& axes, const gpu::SampleRec& sample,
                  std::span<double> point) noexcept;

/// Cells at least half a distance wide, in a table of about as many heads as there are cells, or
/// candidates where those are fewer, see shaders/lib/grid.glsl.
struct BoxGrid {
    std::array<gpu::AxisRec, gpu::kMostAxes> axes{};
    std::uint32_t heads; ///< A power of two.
    float limit2;        ///< Conflict below this square of a distance, in units of the minimum.
    std::uint64_t draw_cells; ///< That candidates are drawn by.

    /// `box` must be as pool_size() asks, and coordinates are steps of `lattice`. Conflicts are
    /// tested against 1 + `guard` distances.
    BoxGrid(const BoxParams& box, const DrawAxes& lattice, std::uint32_t candidates, double guard);
};

} // namespace geodisk
