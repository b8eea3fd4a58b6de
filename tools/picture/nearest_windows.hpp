// The windows of a table by which a place finds the nearest samples alone.
#pragma once

#include <span>

#include "picture/window_table.hpp"

namespace geodisk::tools::picture {

/// Drops the windows that no place of their cell needs to find the sample nearest to it, by
/// distances in `radii` in units of the table, and all others that are at most `margin` radii
/// farther. The disks of the table reach `reach` radii.
void keep_nearest(WindowTable& table, std::span<const double> radii, double reach, double margin);

} // namespace geodisk::tools::picture
