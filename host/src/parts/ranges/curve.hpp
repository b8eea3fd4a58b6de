// Divides faces among processes along a curve that fills space.
#pragma once

#include <cstdint>
#include <vector>

#include <geodisk/mesh_range.hpp>

#include "parts/ranges/examine.hpp"
#include "parts/ranges/talk.hpp"

namespace geodisk {

/// Returns the process of each face of a range, so that all processes have about the same work: by
/// the areas of faces, of which `area` is the sum of all, and by their number. Each has a face;
/// there must be as many faces as processes. All processes call it.
std::vector<std::uint32_t> divide_by_curve(Talk& talk, const MeshRange& range, RangeFaces faces,
                                           const RangeFindings& findings, double area);

} // namespace geodisk
