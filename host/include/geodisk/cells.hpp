// Cells: which part of a surface is nearer to a sample than to all others, along the surface.
// Experimental.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/export.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/sample.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Settings of find_cells().
struct CellParams {
    /// Finds which cells touch, and where three meet.
    bool has_dual = true;
    /// Maximum number of records of paths, 36 bytes each on the host. Some 10 to 1,000 per sample
    /// are usual.
    std::uint64_t max_records = std::uint64_t{1} << 27;
    /// A byte per face: 0 for one whose area counts for no cell, and where no cells touch.
    /// Distances still cross such faces. Empty to take all faces. Must outlive what is made with
    /// it.
    std::span<const std::uint8_t> face_mask{};
};

/// The shape of a dual graph beside that of the mesh.
struct DualReport {
    std::uint64_t vertices = 0;  ///< Samples with a cell.
    std::uint64_t edges = 0;     ///< Pairs of cells that touch.
    std::uint64_t triangles = 0; ///< Places where three cells meet.
    std::uint64_t manifold = 0;  ///< Triangles whose edges have one or two triangles each, and
                                 ///< whose corners have one fan of triangles each.
    std::int64_t euler = 0;      ///< vertices - edges + triangles.
    std::int64_t mesh_euler = 0; ///< Euler characteristic of the mesh.
};

/// The geodesic Voronoi cells of samples.
struct SurfaceCells {
    /// Area of the cell of each sample, in square mesh units. The areas sum to the area of the
    /// surface, or of the faces that CellParams::face_mask takes, minus `unreached`.
    std::vector<double> areas;
    /// Maximum error of an area. Includes regions that tie between samples, such as those behind a
    /// saddle vertex.
    double area_error = 0;
    double distance_error = 0; ///< Bound on the error of distances, in mesh units.
    double unreached = 0;      ///< Area of the parts of the mesh without a sample.
    /// Pairs of samples whose cells touch along a line, each once: the lower sample first.
    /// Ascending. Empty without CellParams::has_dual.
    std::vector<std::array<std::uint32_t, 2>> edges;
    /// Triangles of samples whose cells meet, oriented like the faces there. Where more than three
    /// cells meet, a fan around the first sample.
    std::vector<std::array<std::uint32_t, 3>> triangles;
    DualReport dual;
    RunReport report;
};

/// Finds the geodesic Voronoi cell of each sample: the points of the surface that are nearer to it
/// than to any other. Ties go to the first sample. The result is the same on every device and for
/// any memory size. Progress counts samples twice as candidates: when their disks are computed, and
/// when their cells are. Returns `cancelled` if it asks to stop. A mesh that the device cannot hold
/// is taken in parts, as by find_neighbours().
///
/// Errors: `invalid_argument` for no sample, or a mask of another size or of no face; for a sample,
/// naming it, in a face that does not exist or repeats a vertex or with weights that are negative
/// or do not sum to 1. `job_too_large` for more than `max_records`, naming how many to expect.
/// Others as Runner::sample_and_wait().
GEODISK_API Result<SurfaceCells> find_cells(Runner& runner, const PreparedMesh& mesh,
                                            std::span<const Sample> samples,
                                            const CellParams& params = {},
                                            const ProgressCallback& progress = {}) noexcept;

} // namespace geodisk
