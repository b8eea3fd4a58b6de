// The geodesic disks of samples as a page carries them, so that its shader finds the exact distance
// at each pixel.
#pragma once

#include <vector>

#include "picture/window_table.hpp"
#include "report/page_array.hpp"

namespace geodisk::tools::report {

/// Numbers that the shader has to know besides the arrays.
struct DiskScale {
    double unit = 1;           ///< Unit of lengths, in mesh units.
    double cells_per_unit = 1; ///< Cells per unit of all faces.
    double seam = 0;           ///< Maximum by which rounding moves what a window lights, in units.
};

struct DiskData {
    std::vector<PageArray> arrays;
    DiskScale scale;
};

/// A table (picture/window_table.hpp) whose faces all have as many cells to the unit, as those of
/// make_window_table() do. Of each face
///   face_frames  longest, apex_x, apex_y
///   face_bases, face_columns, face_rows
/// of each cell
///   cell_windows  how many windows it has
/// and of each window, in order
///   window_x, window_y    its source, from the cell's corner on
///   window_sigmas
///   window_left, window_right  angles of the normals, 1 to 65535 for 0 to 2 pi; 0 for no normal
///   window_samples
DiskData disk_data(const picture::WindowTable& table);

} // namespace geodisk::tools::report
