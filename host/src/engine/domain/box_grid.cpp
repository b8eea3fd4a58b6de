#include "engine/domain/box_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace geodisk {
namespace {

// Odd multipliers with well-mixed bits. They hash the cells of an axis if a table cannot hold them
// all.
constexpr std::uint32_t kHashStrides[gpu::kMaxAxes] = {1u,          0x9E3779B1u, 0xB5297A4Du,
                                                       0x68E31DA5u, 0x1B56C4E9u, 0x7FEB352Du};
// Bits of a coordinate within a cell for drawing candidates, if the side has the usual length.
constexpr int kCellBits = 16;
constexpr int kShortSideBits = 31;

double relative_side(const BoxParams& box, std::size_t axis) {
    return box.extents[axis] / unit_of(box);
}

/// Returns how often the width of cells for drawing candidates is doubled. It is normally one
/// distance. If the first stage of darts has fewer than kStageRatio per sample, cells are larger in
/// proportion.
int doublings(const BoxParams& box) {
    const Stages stages = stages_of(box);
    const double fewer = kStageRatio / stages.per_sample(0);
    const double dimensions = static_cast<double>(box.extents.size());
    return stages.is_counted() && fewer > 1
               ? static_cast<int>(std::ceil(std::log2(fewer) / dimensions))
               : 0;
}

// Steps depend only on the unit, so that a larger box has the same ones. A periodic box needs a
// whole number of them.
DrawAxis draw_axis(const BoxParams& box, std::size_t axis, int doubled) {
    const double side = relative_side(box, axis);
    DrawAxis draw{};
    if (box.is_periodic) {
        draw.step = box.extents[axis] * 0x1p-32;
        draw.steps = std::uint64_t{1} << 32;
        draw.cells =
            static_cast<std::uint32_t>(std::max(1.0, std::floor(std::ldexp(side, -doubled))));
        draw.width = draw.cells == 1 ? 0 : static_cast<std::uint32_t>(draw.steps / draw.cells);
    } else {
        int bits = side < 1 ? kShortSideBits : kCellBits;
        while (side > 1 && std::ldexp(side, bits) > 0x1p32) {
            --bits;
        }
        draw.step = std::ldexp(unit_of(box), -bits);
        draw.steps = static_cast<std::uint64_t>(std::max(1.0, std::floor(std::ldexp(side, bits))));
        draw.width = std::uint32_t{1} << std::min(bits + doubled, kShortSideBits);
        draw.cells = static_cast<std::uint32_t>((draw.steps + draw.width - 1) / draw.width);
    }
    draw.last_width = static_cast<std::uint32_t>(
        draw.steps - static_cast<std::uint64_t>(draw.cells - 1) * draw.width);
    return draw;
}

} // namespace

double unit_of(const BoxParams& box) noexcept {
    const double longest = *std::max_element(box.extents.begin(), box.extents.end());
    double sum = 0;
    for (const double side : box.extents) {
        sum += (side / longest) * (side / longest);
    }
    return std::min(box.min_distance, 1.01 * longest * std::sqrt(sum));
}

DrawAxes draw_axes(const BoxParams& box) noexcept {
    DrawAxes axes{};
    const int doubled = doublings(box);
    for (std::size_t i = 0; i < box.extents.size(); ++i) {
        axes[i] = draw_axis(box, i, doubled);
    }
    return axes;
}

DrawAxes finest_axes(const BoxParams& box) noexcept {
    DrawAxes axes{};
    for (std::size_t i = 0; i < box.extents.size(); ++i) {
        axes[i] = {box.extents[i] * 0x1p-32, std::uint64_t{1} << 32, 1, 0, 0};
    }
    return axes;
}

BoxGrid::BoxGrid(const BoxParams& box, const DrawAxes& lattice, std::uint32_t candidates,
                 double guard)
    : limit2(static_cast<float>((1 + guard) * (1 + guard))) {
    // Cells are slightly wider than the reach of a disk requires.
    const double slack = 1 + 4 * guard;
    const double unit = unit_of(box);
    double all_cells = 1;
    draw_cells = 1;
    for (std::size_t i = 0; i < box.extents.size(); ++i) {
        const DrawAxis& draw = lattice[i];
        const double step = draw.step / unit;
        const double side = static_cast<double>(draw.steps) * step;
        const double cells = std::max(1.0, std::floor(side * gpu::kGridReach / slack));
        all_cells *= cells;
        draw_cells *= draw.cells;
        axes[i].cells =
            static_cast<std::uint32_t>(cells) | (box.is_periodic ? gpu::kPeriodicAxis : 0);
        axes[i].unit = static_cast<float>(step);
        axes[i].draw_cells = draw.cells;
        axes[i].draw_width = draw.width;
        axes[i].last_width = draw.last_width;
        // Rounded down, so that cells are not narrower and not more numerous than planned.
        const double per_step = std::floor(cells * 0x1p32 / static_cast<double>(draw.steps));
        axes[i].per_step = cells > 1 ? static_cast<std::uint32_t>(per_step) : 0;
        axes[i].width = static_cast<float>(cells > 1 ? 0x1p32 / per_step * step : side);
    }
    // A 32-bit power of two, although no device binds that many.
    const double most = std::min(double{kHeadsPerCandidate} * candidates, 0x1p31);
    heads = std::bit_ceil(static_cast<std::uint32_t>(std::min(all_cells, most)));
    const bool fits = all_cells <= heads;
    std::uint32_t cells_before = 1;
    for (std::size_t i = 0; i < box.extents.size(); ++i) {
        axes[i].stride = fits ? cells_before : kHashStrides[i];
        cells_before *= axes[i].cells & ~gpu::kPeriodicAxis;
    }
}

} // namespace geodisk
