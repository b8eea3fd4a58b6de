// Files of the dual graph of cells: a mesh whose vertices are the samples.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "files/output/output_file.hpp"
#include "files/samples/sample_file.hpp"
#include "geometry/mesh.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

enum class DualFormat : std::uint8_t { obj, ply, npz, vtp };

/// Returns the format of that extension. Throws UserError(usage) for another one.
DualFormat dual_format(const Path& path);

/// Samples as vertices, and which of them are joined.
struct DualMesh {
    std::vector<double> points; ///< `dimension` coordinates each.
    std::uint32_t dimension = 3;
    std::span<const std::array<std::uint32_t, 2>> edges;
    std::span<const std::array<std::uint32_t, 3>> triangles;
    std::span<const SampleField> fields; ///< Attributes of the samples.
};

/// Throws UserError(usage) for coordinates and attributes that the format does not hold, naming
/// --dual: OBJ, PLY and VTP hold three coordinates, OBJ the attributes color and uv alone.
void check_dual(DualFormat format, std::uint32_t dimension, std::span<const MeshField> fields);

/// Writes vertices and triangles as OBJ, PLY or VTP, with attributes of the vertices, or the arrays
/// points, edges, triangles and those of attributes as an .npz archive. Coordinates read back as
/// they are.
void write_dual(AtomicFile& file, DualFormat format, const DualMesh& mesh);

} // namespace geodisk::tools
