// Writes the prepared meshes of a job as records of the shaders, with lengths in units of the
// minimum distance. Data that depends on the meshes alone comes first, then data that depends on
// parameters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <geodisk/status.hpp>

#include "engine/domain/placed_surface.hpp"

namespace geodisk {

/// Counts the cells of all faces; 0 if each face has one. Errors: more than 2^30, naming the face.
Result<std::uint32_t> count_cells(PlacedSurfaces surfaces);

/// Returns the area of a face as kernels compute it, with lengths in units of `unit`.
float face_area(const PreparedMesh& mesh, std::uint32_t face, double unit);

/// Bytes of a row of the buffers.
inline constexpr std::size_t kRowBytes = 16;

// Return the bytes that the functions below write.
std::size_t half_edge_bytes(PlacedSurfaces surfaces);
std::size_t length_bytes(PlacedSurfaces surfaces);
std::size_t fan_bytes(PlacedSurfaces surfaces);
std::size_t radii_bytes(PlacedSurfaces surfaces); ///< 0 if radii do not vary.
std::size_t key_bytes(PlacedSurfaces surfaces);   ///< Whole rows; 0 without keys.

void write_half_edges(PlacedSurfaces surfaces, std::span<std::byte> out);
void write_lengths(PlacedSurfaces surfaces, bool one_cell_each, std::span<std::byte> out);
void write_fans(PlacedSurfaces surfaces, std::span<std::byte> out);
Result<Done> write_radii(PlacedSurfaces surfaces, std::span<std::byte> out);
void write_keys(PlacedSurfaces surfaces, std::span<std::byte> out);

} // namespace geodisk
