// The prepared meshes of a job as the records of the shaders, lengths in units of the minimum
// distance. What follows from the meshes alone comes before what their parameters tell.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <geodisk/status.hpp>

#include "engine/domain/placed_surface.hpp"

namespace geodisk {

/// Cells of all faces together, 0 where each face has one; more than 2^30 is an error naming the
/// face.
Result<std::uint32_t> count_cells(PlacedSurfaces surfaces);

/// The area of a face in units of working_distance(), which is `unit`, as kernels compute it.
float face_area(const PreparedMesh& mesh, std::uint32_t face, double unit);

// Bytes of the buffers, and of what each function below fills.
std::size_t half_edge_bytes(PlacedSurfaces surfaces);
std::size_t length_bytes(PlacedSurfaces surfaces);
std::size_t fan_bytes(PlacedSurfaces surfaces);
std::size_t radii_bytes(PlacedSurfaces surfaces); ///< 0 where they do not vary.
std::size_t key_bytes(PlacedSurfaces surfaces);   ///< A word even where the caller gives none.

void write_half_edges(PlacedSurfaces surfaces, std::span<std::byte> out);
void write_lengths(PlacedSurfaces surfaces, bool one_cell_each, std::span<std::byte> out);
void write_fans(PlacedSurfaces surfaces, std::span<std::byte> out);
Result<Done> write_radii(PlacedSurfaces surfaces, std::span<std::byte> out);
void write_keys(PlacedSurfaces surfaces, std::span<std::byte> out);

} // namespace geodisk
