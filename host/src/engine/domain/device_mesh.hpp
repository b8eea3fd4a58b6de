// Turns the prepared meshes of a job into records of the shaders, with lengths in units of the
// minimum distance. Data that depends on the meshes alone comes first, then data that depends on
// parameters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <geodisk/status.hpp>

#include "engine/domain/placed_surface.hpp"
#include "engine/domain/upload_parts.hpp"
#include "records.h"

namespace geodisk {

/// The cells of faces, numbered through all of them.
struct FaceCells {
    std::uint32_t count = 0;           ///< Number of cells of all faces; 0 if each face has one.
    std::vector<std::uint32_t> firsts; ///< First cell of every kBlock-th face; empty likewise.
};

/// Counts the cells. Errors: more than 2^30, naming the face.
Result<FaceCells> count_cells(PlacedSurfaces surfaces);

/// The grid of cells over a face, in the frame of its longest edge.
struct FaceGrid {
    std::uint32_t first; ///< First cell, row by row.
    std::uint32_t columns, rows;
    std::uint32_t corner; ///< Corner where the longest edge starts.
    double cell;          ///< Width of a cell, in mesh units.

    /// Returns the cell of the point with these weights of the second and third corner. A point on
    /// a border between cells may be in either.
    std::uint32_t cell_of(const PreparedMesh& mesh, std::uint32_t face, double weight1,
                          double weight2) const;
};

/// Visits the grids of all faces of a surface that has more cells than faces.
void for_face_grids(const PlacedSurface& surface,
                    const std::function<void(std::uint32_t face, const FaceGrid&)>& visit);

/// Returns the area of a face as kernels compute it, with lengths in units of `unit`.
float face_area(const PreparedMesh& mesh, std::uint32_t face, double unit);

/// Returns the key by which the candidates of a face are drawn.
std::uint32_t key_of(const PlacedSurface& surface, std::uint32_t face);

/// Returns the radii of a face without the bound; all are half of the unit if radii do not vary.
gpu::RadiiRec radii_of(const SampleParams& params, std::uint32_t face);

/// Bytes of a row of the buffers.
inline constexpr std::size_t kRowBytes = 16;

// Return the bytes of the parts below.
std::size_t half_edge_bytes(PlacedSurfaces surfaces);
std::size_t length_bytes(PlacedSurfaces surfaces);
std::size_t fan_bytes(PlacedSurfaces surfaces);
std::size_t radii_bytes(PlacedSurfaces surfaces); ///< 0 if radii do not vary.
std::size_t key_bytes(PlacedSurfaces surfaces);   ///< Whole rows; 0 without keys.

// Append what is to be uploaded. All arguments must outlive `parts`.
void add_half_edges(PlacedSurfaces surfaces, UploadParts& parts);
void add_lengths(PlacedSurfaces surfaces, const FaceCells& cells, UploadParts& parts);
void add_fans(PlacedSurfaces surfaces, UploadParts& parts);
Result<Done> add_radii(PlacedSurfaces surfaces, UploadParts& parts);
void add_keys(PlacedSurfaces surfaces, UploadParts& parts);

} // namespace geodisk
