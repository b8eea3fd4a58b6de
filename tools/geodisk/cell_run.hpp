// The cells of samples on a mesh, and the mesh that is their dual graph.
#pragma once

#include <span>
#include <vector>

#include <geodisk/cells.hpp>

#include "files/dual_file.hpp"
#include "files/sample_file.hpp"
#include "geodisk/device_run.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geometry/triangle_angles.hpp"

namespace geodisk::tools {

struct CellResult {
    SurfaceCells cells;
    std::vector<double> points; ///< Coordinates of the samples, as many as the mesh has each.
    TriangleAngles angles;      ///< Of the flat triangles of the dual graph.
    DeviceRun done;
};

/// Opens the device where need be and finds the cells of the samples in `rows`. Throws UserError.
CellResult run_cells(std::span<const SampleRow> rows, bool has_dual, const MeshInput& mesh,
                     RunDevice& device, bool is_bounded, ProgressLine& progress);

/// Returns the column `area` of a sample file.
SampleField area_field(const SurfaceCells& cells);

/// Returns the dual graph to write. `result` must outlive it.
DualMesh dual_mesh(const CellResult& result, const MeshInput& mesh);

} // namespace geodisk::tools
