// Straight-line distances between samples in a box, in double precision.
#pragma once

#include <span>

#include <geodisk/box.hpp>

#include "common/sample_file.hpp"
#include "geodisk/progress.hpp"
#include "geodisk/spacing_result.hpp"

namespace geodisk::tools {

/// Computes the distances of all pairs that are not much farther apart than the minimum distance
/// of the box. Rows must lie in it. Throws UserError when interrupted.
SpacingResult check_box_spacing(const BoxParams& box, std::span<const SampleRow> rows,
                                ProgressLine& progress);

} // namespace geodisk::tools
