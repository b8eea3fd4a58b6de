// Samples too close to points to avoid, found in double precision by the reference implementation.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/sample.hpp>

#include "files/samples/sample_file.hpp"
#include "geodisk/inputs/line_input.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/outputs/progress.hpp"

namespace geodisk::tools {

/// A sample within the radius of a point to avoid: of several points, of one in whose disk it lies
/// deepest. A disk beyond the whole mesh stands for all others.
struct Intrusion {
    std::uint32_t row;
    std::size_t point;
    double distance;
};

/// Finds the rows within the radii of the points by more than a billionth, in their order. Rows
/// with `existing` other than 0 may be anywhere; none do if that is empty. `classes` are those of
/// the rows, or none. Throws UserError when interrupted.
std::vector<Intrusion> find_intrusions(const MeshInput& mesh, std::span<const SampleRow> rows,
                                       std::span<const std::uint32_t> existing,
                                       std::span<const std::uint32_t> classes,
                                       const Avoided& avoided, ProgressLine& progress);

} // namespace geodisk::tools
