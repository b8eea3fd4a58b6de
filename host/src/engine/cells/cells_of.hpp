// cells_of: the cells of samples, from their disks.
#pragma once

#include <geodisk/cells.hpp>

#include "engine/cells/lit_samples.hpp"

namespace geodisk {

/// Finds the cells as find_cells() does. Progress counts samples twice as candidates; their disks
/// are computed by then.
Result<SurfaceCells> cells_of(const PreparedMesh& mesh, const LitSamples& samples,
                              const ThreadOptions& threads, const ProgressCallback& progress);

} // namespace geodisk
