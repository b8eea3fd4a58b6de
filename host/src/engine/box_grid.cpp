#include "engine/box_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace geodisk {
namespace {

// Odd, with bits all over: what the cells of an axis are multiplied by where a table cannot hold
// them all.
constexpr std::uint32_t kHashStrides[gpu::kMostAxes] = {1u,          0x9E3779B1u, 0xB5297A4Du,
                                                        0x68E31DA5u, 0x1B56C4E9u, 0x7FEB352Du};
// Of a distance: sides below it count as zero, which keeps denormal numbers out.
constexpr double kSmallestSide = 0x1p-20;

/// The minimum distance, or where that is beyond all distances in the box, a bound of those.
double unit_of(const BoxParams& box) {
    const double longest = *std::max_element(box.extents.begin(), box.extents.end());
    double sum = 0;
    for (const double side : box.extents) {
        sum += (side / longest) * (side / longest);
    }
    return std::min(box.min_distance, 1.01 * longest * std::sqrt(sum));
}

} // namespace

BoxGrid::BoxGrid(const BoxParams& box, std::uint32_t candidates, double guard)
    : limit2(static_cast<float>((1 + guard) * (1 + guard))) {
    // Cells are somewhat wider than the reach of a disk asks.
    const double slack = 1 + 4 * guard;
    const double unit = unit_of(box);
    double all_cells = 1;
    for (std::size_t i = 0; i < box.extents.size(); ++i) {
        const double side = box.extents[i] / unit;
        const double cells = std::max(1.0, std::floor(side * gpu::kGridReach / slack));
        all_cells *= cells;
        axes[i].cells =
            static_cast<std::uint32_t>(cells) | (box.is_periodic ? gpu::kPeriodicAxis : 0);
        axes[i].unit = side < kSmallestSide ? 0.0f : static_cast<float>(side * 0x1p-32);
        axes[i].width = static_cast<float>(side / cells);
    }
    heads = std::bit_ceil(
        static_cast<std::uint32_t>(std::min<double>(all_cells, kHeadsPerCandidate * candidates)));
    const bool fits = all_cells <= heads;
    std::uint32_t cells_before = 1;
    for (std::size_t i = 0; i < box.extents.size(); ++i) {
        axes[i].stride = fits ? cells_before : kHashStrides[i];
        cells_before *= axes[i].cells & ~gpu::kPeriodicAxis;
    }
}

} // namespace geodisk
