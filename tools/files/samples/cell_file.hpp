// Files of cells as geometry: the mesh in pieces that each lie in one cell, and the borders of
// cells.
#pragma once

#include <cstdint>

#include "files/output/output_file.hpp"
#include "geometry/cell_borders.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

enum class CellFormat : std::uint8_t { obj, ply, vtp };

/// Returns the format of that extension, of `what` is written. Throws UserError(usage) for another
/// one.
CellFormat cell_format(const Path& path, const char* what);

/// Writes the triangles, each with the index of its sample (-1 for none) and of its face: as cells
/// of VTK with arrays `sample` and `face`, as faces of PLY with such properties, or in OBJ a group
/// for each sample.
void write_cell_mesh(AtomicFile& file, CellFormat format, const CutCells& cells);

/// Writes the borders as lines, each with the two samples between which it is: `sample` and `other`
/// as arrays of VTK, or properties of PLY's edges; in OBJ lines alone.
void write_cell_outlines(AtomicFile& file, CellFormat format, const CutCells& cells);

} // namespace geodisk::tools
