// The geodesic disks of samples, in the form that a shader finds the exact distance of any point
// by: all windows of all samples, by the place on the surface that they light.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <geodisk/mesh.hpp>

#include "geometry/surface_disk.hpp"
#include "picture_records.h"
#include "program/batches.hpp"

namespace geodisk::tools::picture {

/// The distance of point p from sample s is the least, over the windows of s in p's cell that p is
/// seen through, of sigma and the straight way to the window's source; p lies outside the disk of s
/// where there is none, or that is larger.
struct WindowTable {
    double unit = 1;                   ///< Unit of all lengths here, in mesh units.
    std::vector<FaceRec> faces;        ///< Cells count from 0 over all faces.
    std::vector<std::uint32_t> starts; ///< Start of each cell's windows, and the end.
    std::vector<WindowRec> windows;    ///< In each cell by sample, ascending.
};

inline constexpr std::size_t kMaxWindows = std::size_t{1} << 25; ///< A gigabyte.

/// `spacing` is the length, in mesh units, that the cells are to suit: about the reach of most.
/// Works on as many threads as there are cores; `tell` is called on the caller's and may throw.
/// Throws UserError: `out_of_memory` for more windows than `most`, `bad_input` for a disk that does
/// not end.
WindowTable make_window_table(const PreparedMesh& mesh, std::span<const SurfaceDisk> disks,
                              double spacing, const PartDone& tell, std::size_t most = kMaxWindows);

/// The same, but nothing for more windows than `most`.
std::optional<WindowTable> try_window_table(const PreparedMesh& mesh,
                                            std::span<const SurfaceDisk> disks, double spacing,
                                            const PartDone& tell, std::size_t most);

} // namespace geodisk::tools::picture
