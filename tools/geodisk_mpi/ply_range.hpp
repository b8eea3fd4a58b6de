// Reads a range of a binary PLY file of triangles, as one of many processes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <geodisk/exchange.hpp>
#include <geodisk/mesh_range.hpp>
#include <geodisk/status.hpp>

#include "geodisk/options/density_options.hpp"
#include "geodisk/options/mask_options.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// Data that a job takes from a file besides its surface.
struct RangeWants {
    std::optional<DensitySource> density; ///< Radii of a property of vertices.
    std::vector<MaskRule> mask;           ///< Rules on properties, and on coordinates of vertices.
    bool has_count = false;               ///< It derives its distance from a count.
};

/// Returns the number of faces by the header of a file; 0 if it has to be read as a whole.
std::uint64_t ply_faces(const Path& path);

/// Reads the range of this process; all call it. Errors, the same on all: `mesh_rejected` for a
/// file that has to be read as a whole, with the reason; `invalid_argument` if the file changes
/// while it is read; those of the exchange. Throws std::bad_alloc.
Result<MeshRange> read_ply_range(Exchange& exchange, const Path& path, const RangeWants& wants);

} // namespace geodisk::tools
