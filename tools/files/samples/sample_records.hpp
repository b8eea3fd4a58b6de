// Normals and frames of samples, by their mesh.
#pragma once

#include <cstdint>
#include <span>

#include "files/samples/sample_file.hpp"
#include "geometry/frames.hpp"
#include "geometry/mesh.hpp"

namespace geodisk::tools {

/// Replaces the normals of faces in `rows` by interpolated means at vertices. `mesh` must have 3
/// coordinates. A normal that cancels to zero stays that of the face.
void set_smooth_normals(const MeshFile& mesh, std::span<SampleRow> rows);

/// The same by MeshFile::normals.
void set_file_normals(const MeshFile& mesh, std::span<SampleRow> rows);

/// Returns a quaternion for each sample, by its normal, face and weights, see frame_of().
SampleField sample_frames(std::span<const SampleRow> rows, std::uint64_t seed,
                          const FrameStyle& style);

} // namespace geodisk::tools
