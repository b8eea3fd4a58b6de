// Finds the faces of a surface that are seen from outside: not the inner shells of a nested one,
// nor the engine in a car. Experimental.
#pragma once

#include <cstdint>
#include <vector>

#include "geodisk/export.hpp"
#include "geodisk/mesh_view.hpp"
#include "geodisk/runner.hpp"
#include "geodisk/status.hpp"
#include "geodisk/threads.hpp"

namespace geodisk {

/// Share of its rays with which a face is seen, if the caller does not say.
inline constexpr double kOutsideShare = 0.02;

/// Returns a byte per face: 1 for one that is seen from outside, 0 for others and for faces without
/// area. Use it as SampleParams::face_mask.
///
/// Rays start at four points of each face, in 64 directions that are spread evenly over the sphere.
/// A face is seen if `share` of the rays on one of its sides, and at least one, meet no other face.
/// A face of a convex surface is seen with a share of 1, one in a deep hole with little.
/// Orientation and connectivity do not matter. The result is the same on every machine. Takes a
/// tree of boxes and up to 256 rays for each face; faces that are seen need few.
///
/// Progress counts faces as candidates. It may be called by any of the threads, by one at a time;
/// returns `cancelled` if it asks to stop.
///
/// Errors: `invalid_argument` for a share outside of 0 to 1, and for a mesh of other than three
/// coordinates; those of PreparedMesh::prepare() for a wrong view, index or coordinate;
/// `out_of_host_memory`.
GEODISK_API Result<std::vector<std::uint8_t>>
outside_faces(const MeshView& mesh, double share = kOutsideShare, const ThreadOptions& threads = {},
              const ProgressCallback& progress = {}) noexcept;

} // namespace geodisk
