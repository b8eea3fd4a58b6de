// Files of the dual graph of cells: a mesh whose vertices are the samples.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "files/output/output_file.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

enum class DualFormat : std::uint8_t { obj, npz };

/// Returns the format of that extension. Throws UserError(usage) for another one.
DualFormat dual_format(const Path& path);

/// Samples as vertices, and which of them are joined.
struct DualMesh {
    std::vector<double> points; ///< `dimension` coordinates each.
    std::uint32_t dimension = 3;
    std::span<const std::array<std::uint32_t, 2>> edges;
    std::span<const std::array<std::uint32_t, 3>> triangles;
};

/// Writes vertices and triangles as OBJ, or the arrays points, edges and triangles as an .npz
/// archive. Coordinates read back as they are. OBJ is for three dimensions.
void write_dual(AtomicFile& file, DualFormat format, const DualMesh& mesh);

} // namespace geodisk::tools
