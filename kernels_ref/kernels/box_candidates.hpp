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
using BoxPoint = std::array<std::uint32_t, gpu::kMaxAxes>;

/// Coordinates of an axis, and its cells for drawing candidates.
struct LatticeAxis {
    double step;          ///< Length of a step, in units of the box.
    std::uint64_t length; ///< Length of the axis in steps, at most 2^32.
    std::uint32_t cells;
    /// Width in steps, 0 for 2^32, of all cells but the last, and of the last.
    std::uint32_t width, last_width;
};

struct BoxLattice {
    /// Unit of lengths: the minimum distance, or an upper bound of all distances in the box if that
    /// is smaller.
    double unit;
    bool is_periodic;
    std::vector<LatticeAxis> axes;

    /// Makes the lattice for drawing candidates in a box.
    explicit BoxLattice(const BoxParams& box);
    /// Returns a lattice with 2^32 steps along every axis and one cell.
    static BoxLattice finest(const BoxParams& box);

    std::uint64_t cell_count() const;
    /// Returns the length of a step in units of the lattice.
    double relative_step(std::size_t axis) const { return axes[axis].step / unit; }
    /// Returns a coordinate in units of the box.
    double coordinate(std::size_t axis, const BoxPoint& point) const {
        return point[axis] * axes[axis].step;
    }
};

/// Returns the unit of a box's lattice.
double box_unit(const BoxParams& box);

/// The stages of a job in a box, and the candidates that each expects per unit of volume.
StageRule stages_in(const BoxParams& box);
float stage_intensity(const BoxParams& box, std::uint32_t stage);

/// Candidates by rank, and their order words.
struct BoxCandidates {
    std::vector<BoxPoint> points;
    std::vector<std::uint32_t> words;
};

/// Draws all candidates of a job. For equal order words, the lower cell comes first.
BoxCandidates draw_in_box(const BoxParams& box);

} // namespace geodisk::ref
