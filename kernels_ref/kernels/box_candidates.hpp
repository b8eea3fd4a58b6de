// Twin of the shaders that draw candidates in a box, cell by cell.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "constants.h"
#include "geodisk/box.hpp"
#include "lib/stages.hpp"

namespace geodisk::ref {

/// Coordinates in steps of a lattice.
using BoxPoint = std::array<std::uint32_t, gpu::kMostAxes>;

/// The coordinates of an axis, and the cells that candidates are drawn in.
struct LatticeAxis {
    double step;          ///< In the units of the box.
    std::uint64_t length; ///< In steps, at most 2^32.
    std::uint32_t cells;
    /// In steps, 0 for 2^32: of all cells but the last, and of that one.
    std::uint32_t width, last_width;
};

struct BoxLattice {
    /// What lengths are measured in: the minimum distance, or where that is beyond all distances in
    /// the box, a bound of those.
    double unit;
    bool is_periodic;
    std::vector<LatticeAxis> axes;

    /// The lattice that a box's candidates are drawn on.
    explicit BoxLattice(const BoxParams& box);
    /// 2^32 steps along every axis, and one cell.
    static BoxLattice finest(const BoxParams& box);

    std::uint64_t cell_count() const;
    /// A step in units of the lattice.
    double relative_step(std::size_t axis) const { return axes[axis].step / unit; }
    /// A coordinate in the units of the box.
    double coordinate(std::size_t axis, const BoxPoint& point) const {
        return point[axis] * axes[axis].step;
    }
};

/// The unit of a box's lattice.
double box_unit(const BoxParams& box);

/// The stages of a job in a box, and the candidates that each expects per unit of volume.
StageRule stages_in(const BoxParams& box);
float stage_intensity(const BoxParams& box, std::uint32_t stage);

/// Candidates by rank, and their order words.
struct BoxCandidates {
    std::vector<BoxPoint> points;
    std::vector<std::uint32_t> words;
};

/// All candidates of a job. Of those with one order word the lower cell comes first.
BoxCandidates draw_in_box(const BoxParams& box);

} // namespace geodisk::ref
