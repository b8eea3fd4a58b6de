// Cells that may reach beyond the disks of their samples.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/threads.hpp>

#include "engine/cells/near_lights.hpp"
#include "engine/maximal/lit_faces.hpp"

namespace geodisk {

/// Returns a mark for each sample that may be the nearest one of a point at the rim of its disk.
/// A cell that does not reach the rim is within the disk, since it has all of the shortest path
/// from the sample to each of its points. Once that holds for all, the nearest sample of each point
/// is among those that light it.
///
/// Radii of disks are in units of the frame.
std::vector<std::uint8_t> open_cells(const PreparedMesh& mesh, const LitFaces& lit,
                                     std::span<const double> radii, const Closeness& closeness,
                                     const ThreadOptions& threads);

} // namespace geodisk
