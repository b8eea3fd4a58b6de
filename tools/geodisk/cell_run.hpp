// The cells of samples on a mesh, and the mesh that is their dual graph.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/cells.hpp>
#include <geodisk/nearest.hpp>

#include "files/samples/dual_file.hpp"
#include "files/samples/sample_file.hpp"
#include "geodisk/device_run.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geometry/cell_borders.hpp"
#include "geometry/triangle_angles.hpp"

namespace geodisk::tools {

struct CellResult {
    SurfaceCells cells;
    std::vector<double> points; ///< Coordinates of the samples, as many as the mesh has each.
    TriangleAngles angles;      ///< Angles of the flat triangles of the dual graph.
    DeviceRun done;
};

/// Returns how many records of paths the host may keep with --memory `bytes`, 0 where it is not
/// given.
std::uint64_t max_records(std::uint64_t bytes);
/// Throws UserError for an error of a search for cells, which was bounded by --memory `bytes`.
void check_cells(const Error& error, std::uint64_t bytes);

/// Opens the device where need be and finds the cells of the samples in `rows`, on the faces of the
/// mesh's mask, with --memory `bytes`. Throws UserError.
CellResult run_cells(std::span<const SampleRow> rows, bool has_dual, const MeshInput& mesh,
                     RunDevice& device, std::uint64_t bytes, ProgressLine& progress);

/// Finds the disks of the samples in `rows`, with --memory `bytes`. The device has begun a search.
/// Throws UserError.
NearestSamples find_nearest(std::span<const SampleRow> rows, const MeshInput& mesh,
                            RunDevice& device, std::uint64_t bytes, ProgressLine& progress);

/// Returns the sample nearest to each vertex of the file; kNone where no path leads to one and for
/// vertices that no face uses.
std::vector<std::uint32_t> samples_at_vertices(const NearestSamples& nearest,
                                               const MeshInput& mesh);

/// Cuts the mesh, which has coordinates, along the borders of the cells of so many samples, on the
/// faces of its mask.
CutCells cut_along_cells(const NearestSamples& nearest, std::size_t samples, const MeshInput& mesh,
                         ProgressLine& progress);

/// Returns the column `area` of a sample file.
inline constexpr const char* kAreaColumn = "area";
SampleField area_field(const SurfaceCells& cells);

/// Returns the dual graph to write, with attributes of the samples. Both must outlive it.
DualMesh dual_mesh(const CellResult& result, const MeshInput& mesh,
                   std::span<const SampleField> fields);

} // namespace geodisk::tools
