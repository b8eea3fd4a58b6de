// The grid of cells over a box, and the hash table that holds it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <geodisk/box.hpp>

#include "constants.h"
#include "records.h"

namespace geodisk {

static_assert(gpu::kMostAxes == kMostBoxDimensions);

/// Heads of a table of cells, in proportion; up to twice as many make a power of two. Sparser
/// tables cost memory, fuller ones make cells share a head.
inline constexpr std::uint64_t kHeadsPerCandidate = 2;

/// Samples per D^n in a periodic box of n dimensions.
double density_in_box(std::size_t dimension) noexcept;

/// Cells at least half a distance wide, in a table of about as many heads as there are cells, or
/// candidates where those are fewer, see shaders/lib/grid.glsl.
struct BoxGrid {
    std::array<gpu::AxisRec, gpu::kMostAxes> axes{};
    std::uint32_t heads; ///< A power of two.
    float limit2;        ///< Conflict below this square of a distance, in units of the minimum.

    /// `box` must be as pool_size() asks. Conflicts are tested against 1 + `guard` distances.
    BoxGrid(const BoxParams& box, std::uint32_t candidates, double guard);
};

} // namespace geodisk
