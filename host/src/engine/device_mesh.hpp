// The prepared mesh as the records of the shaders, in units of the minimum distance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Cells of all faces together, 0 where each face has one; more than 2^30 is an error naming the
/// face.
Result<std::uint32_t> count_cells(const PreparedMesh& mesh, const SampleParams& params);

/// The area of a face in units of working_distance(), which is `unit`, as kernels compute it.
float face_area(const PreparedMesh& mesh, std::uint32_t face, double unit);

std::size_t face_bytes(const PreparedMesh& mesh);
/// With a row of radii per face in a run of varying ones.
std::size_t fan_bytes(const PreparedMesh& mesh, bool adaptive);
/// A word even where the caller gives no keys.
std::size_t key_bytes(const SampleParams& params);

// Each fills exactly its number of bytes.
void write_faces(const PreparedMesh& mesh, const SampleParams& params, bool one_cell_each,
                 std::span<std::byte> out);
Result<Done> write_fans(const PreparedMesh& mesh, const SampleParams& params,
                        std::span<std::byte> out);
void write_keys(const SampleParams& params, std::span<std::byte> out);

} // namespace geodisk
