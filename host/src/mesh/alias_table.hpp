// The area-proportional choice of a face as a table lookup (Walker 1977, Vose 1991), in integers.
#pragma once

#include <span>
#include <vector>

#include "geodisk/mesh.hpp"

namespace geodisk {

/// One column per face. Face weights are rounded to 2^-32 of a column, and their sum is exact, so a
/// face without area is never drawn and every other one with its area's share to within 2^-32 of a
/// column. `total` is the sum of `areas` and positive.
std::vector<AliasColumn> build_alias_table(std::span<const double> areas, double total);

} // namespace geodisk
