// Reads a range of a binary PLY file of triangles, as one of many processes.
#pragma once

#include <geodisk/status.hpp>

#include "parts/exchange.hpp"
#include "parts/ranges/mesh_range.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// Reads the range of this process; all call it. Errors, the same on all: `mesh_rejected` for a
/// file that has to be read as a whole, with the reason; `invalid_argument` if the file changes
/// while it is read; those of the exchange. Throws std::bad_alloc.
Result<MeshRange> read_ply_range(Exchange& exchange, const Path& path);

} // namespace geodisk::tools
